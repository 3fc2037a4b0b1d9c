(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* A pair that the checker shows to be a tie by a ring is weakly Delaunay and not strictly, wherever in their rectangles the
   sites are that the block does not describe. *)
From Coq Require Import Reals Lra Lia ZArith NArith List Bool.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve CheckerTree Checker CheckerSound CheckerEnclosure.
From Dyadel Require Import CheckerEnclosureSound CheckerAlgebra CheckerAlgebraSound CheckerBlock CheckerBlockSound
  CheckerVanish CheckerFacts.
From Dyadel Require Import CheckerFactsSound CheckerTiesSound CheckerRing.
Import ListNotations.
Open Scope R_scope.

(* An affine function that is 0 at a and b, and positive at k and m,
  which are on both sides of their line: there is none. *)
Lemma both_sides (px py ex ey kx ky mx my : R) : px * ex + py * ey = 0 -> 0 < px * kx + py * ky ->
  0 < px * mx + py * my ->
  0 < ex * ky - ey * kx -> ex * my - ey * mx < 0 -> False.
Proof.
  intros Z K M A B. set (n := ex * ex + ey * ey). set (q := ex * py - ey * px).
  assert (Ek : n * (px * kx + py * ky) = q * (ex * ky - ey * kx)).
  { transitivity ((px * ex + py * ey) * (ex * kx + ey * ky) + q * (ex * ky - ey * kx)); [unfold n, q;
    ring | rewrite Z; ring]. }
  assert (Em : n * (px * mx + py * my) = q * (ex * my - ey * mx)).
  { transitivity ((px * ex + py * ey) * (ex * mx + ey * my) + q * (ex * my - ey * mx)); [unfold n, q;
    ring | rewrite Z; ring]. }
  assert (N : 0 < n).
  { unfold n. pose proof (Rle_0_sqr ex) as Sx. pose proof (Rle_0_sqr ey) as Sy. unfold Rsqr in Sx, Sy.
    destruct (Req_dec (ex * ex + ey * ey) 0) as [E | E]; [| lra].
      destruct (Rplus_sqr_eq_0 ex ey) as [X Y]; [unfold Rsqr; lra |].
    rewrite X, Y in A. lra. }
  pose proof (Rmult_lt_0_compat _ _ N K) as P. pose proof (Rmult_lt_0_compat _ _ N M) as Q. rewrite Ek in P.
    rewrite Em in Q.
  destruct (Rle_lt_dec q 0) as [L | L]; [nra |].
    assert (0 < q * - (ex * my - ey * mx)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Section Sound.

Variable v : Z -> R.
Variable l : nat -> R.
Variable most u : Z.
Variable U : (0 < u)%Z.
Variable st : state.
Variable St : state_ok v l u st.
Variable hint : poly -> cofactor.
Variable sites : list site.
Variable B : nat -> rect.
Variable D : describes sites B.
Variable g : tied_ring.
(* A choice, in which the members of the ring are where the block says. *)
Variable p : nat -> point.
Variable P : choice (length sites) B p.
Variable At : forall k m, In m (members g) -> named sites k (fst m) -> p k = point_of v (snd m).

Notation ok := (known_ok l u).

Lemma side_known_ok lo hi x : value lo <= x <= value hi -> ok (side_known u lo hi) x.
Proof.
  intros X. unfold side_known. destruct (fraction_of lo) as [a b] eqn:Fa. destruct (fraction_of hi) as [c d] eqn:Fc.
  split; [| exact I]. cbn [within]. destruct ((0 <? den lo) && (0 <? den hi))%Z eqn:E; [| exact I].
  apply andb_prop in E as [E F]. apply Z.ltb_lt in E, F. destruct (fraction_value lo E) as [La Pb].
  destruct (fraction_value hi F) as [Lc Pd]. rewrite Fa in *. rewrite Fc in *. cbn [fst snd] in *.
  rewrite La, Lc in X. exact (join_holds u U _ _ _ _ _ (fraction_holds u a b Pb) (fraction_holds u c d Pd) X).
Qed.

Lemma product_of_signs e f x y : holds u e x -> holds u f y -> (sign_of e * sign_of f = 1)%Z -> 0 < x * y.
Proof.
  intros X Y E. destruct (sign_cases e) as [S | [S | S]], (sign_cases f) as [T | [T | T]]; rewrite S, T in E;
    try discriminate E.
  - apply Rmult_lt_0_compat; [exact (sign_positive u U e x X S) | exact (sign_positive u U f y Y T)].
  - pose proof (sign_negative u U e x X S). pose proof (sign_negative u U f y Y T).
    replace (x * y) with (- x * - y) by ring. apply Rmult_lt_0_compat; lra.
Qed.

Lemma place_found i a : place_of (there sites g) i = Some a -> exists m k,
  In m (members g) /\ fst m = i /\ snd m = a /\
  named sites k i.
Proof.
  unfold place_of. destruct (find _ _) as [m |] eqn:F; [| discriminate]. intros E. injection E as <-.
  apply find_some in F as [M N]. apply Z.eqb_eq in N. apply filter_In in M as [M T].
    apply existsb_exists in T as (s & Is & Ns).
  apply Z.eqb_eq in Ns. apply In_nth_error in Is as [k K]. exists m, k. repeat split; trivial. exists s.
    split; [exact K | congruence].
Qed.

Lemma crossed_member i j a b s : existsb (fun m => negb (fst m =? i)%Z && negb (fst m =? j)%Z && (side_of most u st
  a b (snd m) =? s)%Z) (there sites g) = true ->
  exists m k, In m (members g) /\ named sites k (fst m) /\ fst m <> i /\ fst m <> j /\ side_of most u st a b (snd m)
    = s.
Proof.
  intros E. apply existsb_exists in E as (m & M & E).
    rewrite !andb_true_iff, !negb_true_iff, !Z.eqb_neq, Z.eqb_eq in E.
  destruct E as [[Ni Nj] S]. apply filter_In in M as [M T]. apply existsb_exists in T as (t & It & Nt).
    apply Z.eqb_eq in Nt.
  apply In_nth_error in It as [k K]. exists m, k. repeat split; trivial. exists t. now split.
Qed.

Lemma named_below k i : named sites k i -> (k < length sites)%nat.
Proof. intros (s & K & _). apply nth_error_Some. congruence. Qed.

Lemma named_apart k m i j : named sites k i -> named sites m j -> i <> j -> k <> m.
Proof. intros (s & K & Ns) (t & M & Nt) N ->. congruence. Qed.

Theorem ring_tie_every_choice pairs e a b : In e pairs -> ~ In e (ring_loose most u st hint sites g pairs) ->
  named sites a (from e) -> named sites b (to e) ->
  weak_edge (length sites) p a b /\ ~ strict_edge (length sites) p a b.
Proof.
  intros I H Na Nb. unfold ring_loose in H. destruct (is_empty_ring most u st hint sites g) eqn:E; [| contradiction].
  cbv zeta in H. match type of H with ~ In e (kept ?f pairs) => destruct (f e) eqn:K; [destruct H;
    now apply in_kept |] end.
  clear H. apply negb_false_iff in K. unfold ring_tie in K.
  destruct (place_of (there sites g) (from e)) as [qa |] eqn:Fa; [| discriminate].
  destruct (place_of (there sites g) (to e)) as [qb |] eqn:Fb; [| discriminate].
  apply place_found in Fa as (ma & _ & Ma & Ea & Qa & _). apply place_found in Fb as (mb & _ & Mb & Eb & Qb & _).
  subst qa qb. rewrite <- Ea in Na. rewrite <- Eb in Nb.
  pose proof (At a ma Ma Na) as Pa. pose proof (At b mb Mb Nb) as Pb.
  apply andb_prop in E as [Fact E]. cbv zeta in E. rewrite forallb_forall in E.
  destruct (circle_holds_ok v l most u U st St hint _ _ _ _ Fact) as [N0 (o & r & R0 & Off & On)].
  assert (OnRing : forall m, In m (members g) -> dist2 o (point_of v (snd m)) = r).
  { intros m [<- | [<- | [<- | M]]]; apply On; [now left | now right; left | now right; right; left |].
    right; right; right. now apply in_map. }
  split.
  - left. exists o, (dist o (p a)). assert (Da : dist2 o (p a) = r) by (rewrite Pa; now apply OnRing).
    split; [| split].
    + rewrite <- dist_sq in Da. pose proof (dist_nonneg o (p a)).
      destruct (Req_dec (dist o (p a)) 0) as [Z | Z]; [rewrite Z in Da; lra | lra].
    + intros i _ [-> | ->]; [reflexivity |]. apply dist_eq. rewrite Da, Pb. now apply OnRing.
    + intros n Kn. apply dist_le. rewrite Da.
      destruct (nth_error sites n) as [s |] eqn:S; [| apply nth_error_None in S; lia].
      specialize (E s (nth_error_In _ _ S)). apply orb_prop in E as [E | E].
      * apply existsb_exists in E as (m & M & Nm). apply Z.eqb_eq in Nm.
        rewrite (At n m M (ex_intro _ s (conj S Nm))). right. symmetry. now apply OnRing.
      * apply Z.eqb_eq in E. destruct (D n s S) as (X0 & X1 & Y0 & Y1). destruct (P n Kn) as [Hx Hy].
        rewrite X0, X1 in Hx. rewrite Y0, Y1 in Hy.
        set (fa := snd (first g)) in *.
        assert (G : 0 < off_at v fa (snd (second g)) (snd (third g)) (p n) * (dx v fa (snd (second g)) * dy v fa
          (snd (third g)) - dy v fa (snd (second g)) * dx v fa (snd (third g)))).
        { refine (product_of_signs _ _ _ _ (proj1 (off_ok v l most u U st St fa (snd (second g)) (snd (third g)) _ _
          (p n) _ _)) _ E).
          - apply less_ok with (1 := St); trivial; [now apply side_known_ok | apply number_at_ok with (1 := St)].
          - apply less_ok with (1 := St); trivial; [now apply side_known_ok | apply number_at_ok with (1 := St)].
          - exact (proj1 (cross_ok v l most u U st St _ _ _ _ _ _ _ _ (step_x_ok v l most u st St fa _) (step_y_ok v
            l most u st St fa _) (step_x_ok v l most u st St fa _) (step_y_ok v l most u st St fa _))). }
        rewrite Off in G. set (q := dx v fa (snd (second g)) * dy v fa (snd (third g)) - dy v fa (snd (second g)) *
          dx v fa (snd (third g))) in *.
        assert (0 < q * q) by nra. left. apply Rmult_lt_reg_l with (q * q); [assumption |]. nra.
  - intros (c & Eq & Out). unfold is_crossed in K. cbv zeta in K. apply andb_prop in K as [Kp Kn].
    apply crossed_member in Kp as (mk & k & Mk & Nk & Nki & Nkj & Sk).
      apply crossed_member in Kn as (mm & m & Mm & Nm & Nmi & Nmj & Sm).
    rewrite <- Ea in Nki, Nmi. rewrite <- Eb in Nkj, Nmj.
    pose proof (Out k (named_below _ _ Nk) (named_apart _ _ _ _ Nk Na Nki) (named_apart _ _ _ _ Nk Nb Nkj)) as Ck.
    pose proof (Out m (named_below _ _ Nm) (named_apart _ _ _ _ Nm Na Nmi) (named_apart _ _ _ _ Nm Nb Nmj)) as Cm.
    apply dist_eq in Eq. apply dist_lt in Ck, Cm. rewrite Pa, ?Pb in *. rewrite (At k mk Mk Nk) in Ck.
      rewrite (At m mm Mm Nm) in Cm.
    pose proof (OnRing ma Ma) as Ra. pose proof (OnRing mb Mb) as Rb. pose proof (OnRing mk Mk) as Rk.
      pose proof (OnRing mm Mm) as Rm.
    pose proof (fun s => cross_ok v l most u U st St _ _ _ _ _ _ _ _ (step_x_ok v l most u st St (snd ma) (snd mb))
      (step_y_ok v l most u st St (snd ma) (snd mb))
      (step_x_ok v l most u st St (snd ma) s) (step_y_ok v l most u st St (snd ma) s)) as Cr.
    pose proof (sign_positive u U _ _ (proj1 (Cr (snd mk))) Sk) as A1.
      pose proof (sign_negative u U _ _ (proj1 (Cr (snd mm))) Sm) as A2.
    unfold dx, dy, dist2 in *.
    refine (both_sides (fst o - fst c) (snd o - snd c) _ _ _ _ _ _ _ _ _ A1 A2); lra.
Qed.

End Sound.

(* However narrower the rectangles are, as long as they hold the points that the block describes: the pair is possible,
   and not legal. *)
Theorem ring_tie_stays v l most u st hint sites B B' g pairs e a b p : (0 < u)%Z -> state_ok v l u st ->
  describes sites B ->
  refined (length sites) B' B -> choice (length sites) B' p ->
  (forall k m, In m (members g) -> named sites k (fst m) -> p k = point_of v (snd m)) ->
  In e pairs -> ~ In e (ring_loose most u st hint sites g pairs) -> named sites a (from e) -> named sites b (to e) ->
  possible (length sites) B' a b /\ ~ legal (length sites) B' a b.
Proof.
  intros U St D Q P At I H Na Nb. pose proof (named_below sites a (from e) Na) as Ka.
  pose proof (named_below sites b (to e) Nb) as Kb. apply (tied_by_choice _ B B' a b p Ka Kb Q P). intros P'.
  exact (ring_tie_every_choice v l most u U st St hint sites B D g p P' At pairs e a b I H Na Nb).
Qed.
