(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* Pairs that no refinement decides [SET-1]: legal for no narrowing, possible for every one. *)
From Coq Require Import Reals Lra Lia Psatz Classical.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc TiedFace.
Open Scope R_scope.

(* The rectangles of F stay, the others are made smaller. *)
Definition narrowing (N : nat) (F : nat -> Prop) (B B' : sites) : Prop :=
  refined N B' B /\ forall k, (k < N)%nat -> F k -> refines (B k) (B' k).

(* g chooses points for the sites of F; a part of the sites is numbered anew, m is the site e m. *)
Theorem part_refutes_legal N M F B B' C (g : nat -> point) (e : nat -> nat) a b :
  narrowing N F B B' -> (forall k, (k < N)%nat -> F k -> inside (g k) (B k)) ->
  (forall m, (m < M)%nat -> (e m < N)%nat /\ (F (e m) -> exact (C m) (g (e m))) /\ (~ F (e m) -> C m = B (e m))) ->
  (a < M)%nat -> (b < M)%nat -> ~ possible M C a b -> ~ legal N B' (e a) (e b).
Proof.
  intros [Re Fix] G E A D Np L. apply Np. clear Np.
  destruct (finite_choice (0, 0) (fun k z => inside z (B' k) /\ (F k -> z = g k)) N) as [p P].
  { intros k K. destruct (classic (F k)) as [H | H].
    - exists (g k). split; [now apply (Fix k K H), G | now intros].
    - exists (nearest (0, 0) (B' k)). split; [apply nearest_inside | tauto]. }
  destruct (E a A) as [Ea _]. destruct (E b D) as [Eb _].
  destruct (legal_sound N B' (e a) (e b) p Ea Eb L) as [c [Eq Out]]; [intros k K; now apply P |].
  left. apply (pair_possible M C a b A D). exists c.
  apply (disc_shows_possible M C (pair a b) (fun m => p (e m)) c (dist c (p (e a)))).
  - intros m H. destruct (E m H) as [K [X Y]]. destruct (P (e m) K) as [I Z].
    destruct (classic (F (e m))) as [T | T]; [rewrite (Z T); apply X, T | rewrite (Y T); now apply (Re (e m) K)].
  - split; [now intros i _ [-> | ->] |]. intros m H. destruct (E m H) as [K _].
    destruct (Nat.eq_dec (e m) (e a)) as [-> | Da]; [lra |].
    destruct (Nat.eq_dec (e m) (e b)) as [-> | Db]; [lra |]. left. now apply Out.
Qed.

Theorem disc_stays_possible N F B B' i j c r : (i < N)%nat -> (j < N)%nat -> narrowing N F B B' ->
  (forall k, k = i \/ k = j -> (F k -> ds c (B k) <= r) /\ (~ F k -> dl c (B k) <= r)) ->
  (forall k, (k < N)%nat -> k <> i -> k <> j -> (F k -> r <= dl c (B k)) /\ (~ F k -> r < ds c (B k))) ->
  possible N B' i j.
Proof.
  intros I J [Re Fix] Ends Others.
  assert (End : forall k, (k < N)%nat -> k = i \/ k = j -> ds c (B' k) <= r).
  { intros k K S. destruct (Ends k S) as [X Y]. destruct (classic (F k)) as [H | H].
    - pose proof (ds_monotone c _ _ (Fix k K H)). specialize (X H). lra.
    - pose proof (dl_monotone c _ _ (Re k K)). pose proof (ds_le_dl c (B' k)). specialize (Y H). lra. }
  assert (Other : forall k, (k < N)%nat -> k <> i -> k <> j -> r <= dl c (B' k)).
  { intros k K Di Dj. destruct (Others k K Di Dj) as [X Y]. destruct (classic (F k)) as [H | H].
    - pose proof (dl_monotone c _ _ (Fix k K H)). specialize (X H). lra.
    - pose proof (ds_monotone c _ _ (Re k K)). pose proof (ds_le_dl c (B' k)). specialize (Y H). lra. }
  left. exists c. intros k K Di Dj. pose proof (Other k K Di Dj).
  pose proof (End i I (or_introl eq_refl)). pose proof (End j J (or_intror eq_refl)). split; lra.
Qed.

(* What stands for the site k: a point of its rectangle if k is in F, else all of it. *)
Definition stands_for (F : nat -> Prop) (B : sites) (k : nat) (Q : point -> Prop) : Prop :=
  (F k /\ exists q, inside q (B k) /\ forall x, Q x <-> x = q) \/ (~ F k /\ forall x, Q x <-> inside x (B k)).

Lemma stands_in_narrowing N F B B' k Q : (k < N)%nat -> narrowing N F B B' -> stands_for F B k Q ->
  exists x, Q x /\ inside x (B' k).
Proof.
  intros K [Re Fix] [[H [q [I E]]] | [H E]].
  - exists q. split; [now apply E | now apply (Fix k K H)].
  - exists (nearest (0, 0) (B' k)). split; [| apply nearest_inside]. apply E, (Re k K), nearest_inside.
Qed.

Section Four.
Variables (N : nat) (F : nat -> Prop) (B B' : sites) (i j s0 s1 s2 s3 : nat) (Q0 Q1 Q2 Q3 : point -> Prop).
Variables (I : (i < N)%nat) (J : (j < N)%nat) (K2 : (s2 < N)%nat) (K3 : (s3 < N)%nat).
Variable narrow : narrowing N F B B'.
Variables (E0 : s0 = i \/ s0 = j) (E1 : s1 = i \/ s1 = j) (D3 : s3 <> i /\ s3 <> j).
Variables (S0 : stands_for F B s0 Q0) (S1 : stands_for F B s1 Q1) (S2 : stands_for F B s2 Q2) (S3 : stands_for F B s3 Q3).

Lemma end_below s : s = i \/ s = j -> (s < N)%nat.
Proof. now intros [-> | ->]. Qed.

(* The disc of a witness. *)
Lemma witness_disc c : witness N B' i j c ->
  (forall s x, s = i \/ s = j -> inside x (B' s) -> dist c x <= Rmax (dl c (B' i)) (dl c (B' j))) /\
  (forall s x, (s < N)%nat -> s <> i -> s <> j -> inside x (B' s) -> Rmax (dl c (B' i)) (dl c (B' j)) < dist c x).
Proof.
  intros W. split.
  - intros s x [-> | ->] H; [apply Rle_trans with (dl c (B' i)); [now apply le_dl | apply Rmax_l] |
      apply Rle_trans with (dl c (B' j)); [now apply le_dl | apply Rmax_r]].
  - intros s x K Di Dj H. destruct (W s K Di Dj). pose proof (ds_le c (B' s) x H). apply Rmax_lub_lt; lra.
Qed.

Theorem crossing_refutes_legal : s2 <> i /\ s2 <> j ->
  (forall x y z w, Q0 x -> Q1 y -> Q2 z -> Q3 w -> (exists m, between m x y /\ between m z w) /\
    exists o r, circle o r x y z /\ dist o w < r) -> ~ legal N B' i j.
Proof.
  intros D2 H [c W]. destruct (witness_disc c W) as [In Out]. set (R := Rmax (dl c (B' i)) (dl c (B' j))) in *.
  destruct (stands_in_narrowing N F B B' s0 Q0 (end_below _ E0) narrow S0) as [x [X Ix]].
  destruct (stands_in_narrowing N F B B' s1 Q1 (end_below _ E1) narrow S1) as [y [Y Iy]].
  destruct (stands_in_narrowing N F B B' s2 Q2 K2 narrow S2) as [z [Z Iz]].
  destruct (stands_in_narrowing N F B B' s3 Q3 K3 narrow S3) as [w [Vw Iw]].
  destruct (H x y z w X Y Z Vw) as [[m [[s [Ts Es]] [t [Tt Et]]]] [o [r [[Ox [Oy Oz]] Ow]]]].
  assert (R0 : 0 <= R) by (apply Rle_trans with (dist c x); [apply dist_nonneg | now apply (In s0)]).
  pose proof (power_le c R x (In s0 x E0 Ix)) as Px. pose proof (power_le c R y (In s1 y E1 Iy)) as Py.
  pose proof (power_gt c R z R0 (Out s2 z K2 (proj1 D2) (proj2 D2) Iz)) as Pz.
  pose proof (power_gt c R w R0 (Out s3 w K3 (proj1 D3) (proj2 D3) Iw)) as Pw.
  pose proof (power_zero o r x Ox). pose proof (power_zero o r y Oy). pose proof (power_zero o r z Oz).
  pose proof (power_lt o r w Ow). pose proof (radical_mix c R o r s x y) as A. pose proof (radical_mix c R o r t z w) as C.
  rewrite <- Es in A. rewrite <- Et in C. unfold radical in A, C.
  set (u := power c R m - power o r m) in *.
  assert (u <= 0).
  { rewrite A. assert (0 <= (1 - s) * - (power c R x - power o r x)) by (apply Rmult_le_pos; lra).
    assert (0 <= s * - (power c R y - power o r y)) by (apply Rmult_le_pos; lra). lra. }
  assert (0 < u); [| lra]. rewrite C.
  set (a := power c R z - power o r z) in *. set (b := power c R w - power o r w) in *.
  assert (Pa : 0 < a) by (unfold a; lra). assert (Pb : 0 < b) by (unfold b; lra).
  clearbody a b. clear - Tt Pa Pb. nra.
Qed.

(* z is in the triangle of three points: on a segment from one to a point between the two others. *)
Theorem triangle_refutes_legal : s2 = i \/ s2 = j ->
  (forall x y z w, Q0 x -> Q1 y -> Q2 z -> Q3 w -> exists m, between m x y /\ between w m z) -> ~ legal N B' i j.
Proof.
  intros E2 H [c W]. destruct (witness_disc c W) as [In Out].
  destruct (stands_in_narrowing N F B B' s0 Q0 (end_below _ E0) narrow S0) as [x [X Ix]].
  destruct (stands_in_narrowing N F B B' s1 Q1 (end_below _ E1) narrow S1) as [y [Y Iy]].
  destruct (stands_in_narrowing N F B B' s2 Q2 K2 narrow S2) as [z [Z Iz]].
  destruct (stands_in_narrowing N F B B' s3 Q3 K3 narrow S3) as [w [Vw Iw]].
  destruct (H x y z w X Y Z Vw) as [m [[s [Ts Es]] [t [Tt Et]]]].
  pose proof (Out s3 w K3 (proj1 D3) (proj2 D3) Iw) as O. apply Rlt_not_le in O. apply O. rewrite Et.
  apply disc_convex; [exact Tt | rewrite Es; apply disc_convex; [exact Ts | now apply (In s0) | now apply (In s1)] |
    now apply (In s2)].
Qed.
End Four.

(* ---- firm rectangles [SET-2] ---- *)

(* X is Y less e on each side. *)
Definition less_on_each_side (e : R) (X Y : rect) : Prop :=
  xlo X = xlo Y + e /\ xhi X = xhi Y - e /\ ylo X = ylo Y + e /\ yhi X = yhi Y - e.

Lemma coordinate_le_dist x y : Rabs (fst x - fst y) <= dist x y /\ Rabs (snd x - snd y) <= dist x y.
Proof.
  pose proof (dist_nonneg x y) as P. pose proof (dist_sq x y) as E. unfold dist2 in E.
  pose proof (Rle_0_sqr (fst x - fst y)) as A. pose proof (Rle_0_sqr (snd x - snd y)) as D. unfold Rsqr in A, D.
  split; apply le_of_squares; try exact P; rewrite <- Rabs_mult, Rabs_pos_eq by lra; lra.
Qed.

Lemma around_inside e X Y x y : less_on_each_side e X Y -> inside x X -> dist x y <= e -> inside y Y.
Proof.
  intros [A [D [E G]]] [[H1 H2] [H3 H4]] L. destruct (coordinate_le_dist x y) as [U V].
  apply Rle_trans with (r3 := e) in U; [| exact L]. apply Rle_trans with (r3 := e) in V; [| exact L].
  assert (K : forall r, Rabs r <= e -> - e <= r <= e) by (intros r; unfold Rabs; destruct (Rcase_abs r); lra).
  apply K in U. apply K in V. unfold inside. lra.
Qed.

Lemma dl_less e X Y c : 0 <= e -> less_on_each_side e X Y -> dl c X <= dl c Y - e.
Proof.
  intros E H. set (x := farthest c X). assert (Ix : inside x X) by apply farthest_inside.
  destruct (Req_dec (dist c x) 0) as [Z | Z].
  - assert (O : dist x (fst x + e, snd x) = e).
    { unfold dist, dist2. simpl. replace (_ + _) with (e * e) by ring. now apply sqrt_square. }
    pose proof (le_dl c Y _ (around_inside e X Y x _ H Ix (Req_le _ _ O))) as L.
    rewrite (dist_zero c x Z), O in L. change (dl c X) with (dist c x). rewrite Z. rewrite (dist_zero c x Z). lra.
  - assert (P : 0 < dist c x) by (pose proof (dist_nonneg c x); lra).
    set (t := 1 + e / dist c x). assert (T : 0 <= e / dist c x).
    { apply Rmult_le_pos; [exact E |]. left. now apply Rinv_0_lt_compat. }
    assert (M : dist x (mix t c x) = e).
    { rewrite <- (mix_1 c x) at 1. rewrite dist_mix_mix. replace (1 - t) with (- (e / dist c x)) by (unfold t; ring).
      rewrite Rabs_Ropp, Rabs_pos_eq by exact T. field. lra. }
    pose proof (le_dl c Y _ (around_inside e X Y x _ H Ix (Req_le _ _ M))) as L.
    rewrite dist_mix_left in L by (unfold t; lra). change (dl c X) with (dist c x).
    replace (t * dist c x) with (dist c x + e) in L by (unfold t; field; lra). lra.
Qed.

Lemma ds_more e X Y c : 0 <= e -> less_on_each_side e X Y -> ~ inside c Y -> ds c Y + e <= ds c X.
Proof.
  intros E H Out. set (x := nearest c X). assert (Ix : inside x X) by apply nearest_inside.
  assert (P : e < dist x c).
  { apply Rnot_le_lt. intros L. now apply Out, (around_inside e X Y x). }
  set (t := e / dist x c). assert (T : 0 <= t <= 1).
  { unfold t. split; [apply Rmult_le_pos; [exact E |]; left; apply Rinv_0_lt_compat; lra |].
    apply (Rmult_le_reg_r (dist x c)); [lra |]. replace (e / dist x c * dist x c) with e by (field; lra). lra. }
  assert (M : dist x (mix t x c) = e) by (rewrite dist_mix_left by lra; unfold t; field; lra).
  pose proof (ds_le c Y _ (around_inside e X Y x _ H Ix (Req_le _ _ M))) as L.
  rewrite dist_sym, dist_mix_right in L by lra. change (ds c X) with (dist c x). rewrite (dist_sym c x).
  replace ((1 - t) * dist x c) with (dist x c - e) in L by (unfold t; field; lra). lra.
Qed.

Definition norm (u : point) : R := dist u (0, 0).

Lemma dot_near u x y : dot u x - dot u y <= norm u * dist x y.
Proof.
  apply le_of_squares; [apply Rmult_le_pos; apply dist_nonneg |]. unfold norm.
  replace (dist u (0, 0) * dist x y * (dist u (0, 0) * dist x y)) with
    ((dist u (0, 0) * dist u (0, 0)) * (dist x y * dist x y)) by ring.
  rewrite !dist_sq. unfold dot, dist2. simpl.
  pose proof (Rle_0_sqr (fst u * (snd x - snd y) - snd u * (fst x - fst y))) as S. unfold Rsqr in S. lra.
Qed.

Lemma highest_more e X Y u : 0 <= e -> u <> (0, 0) -> less_on_each_side e X Y ->
  dot u (highest u X) + norm u * e <= dot u (highest u Y).
Proof.
  intros E U H. set (x := highest u X). assert (Ix : inside x X) by apply highest_spec.
  assert (P : 0 < norm u) by now apply dist_pos.
  assert (S : norm u * norm u = fst u * fst u + snd u * snd u) by (unfold norm; rewrite dist_sq; unfold dist2; simpl; ring).
  set (t := e / norm u). set (y := (fst x + t * fst u, snd x + t * snd u)).
  assert (Y0 : dist x y = e).
  { unfold dist. replace (dist2 x y) with (e * e); [now apply sqrt_square |].
    transitivity (t * t * (norm u * norm u)); [unfold t; field; lra | rewrite S; unfold y, dist2; simpl; ring]. }
  destruct (highest_spec u Y) as [_ Hi]. specialize (Hi y (around_inside e X Y x y H Ix (Req_le _ _ Y0))).
  replace (dot u y) with (dot u x + t * (norm u * norm u)) in Hi by (rewrite S; unfold y, dot; simpl; ring).
  replace (t * (norm u * norm u)) with (norm u * e) in Hi by (unfold t; field; lra). exact Hi.
Qed.

Section Firm.
Variables (N : nat) (F firm : nat -> Prop) (B B' C : sites) (q : nat -> point) (e : R) (i j : nat).
Variables (I : (i < N)%nat) (J : (j < N)%nat) (Pe : 0 < e).
Variable narrow : narrowing N F B B'.
Variable small_ones : forall k x y, (k < N)%nat -> ~ F k -> inside x (B k) -> inside y (B k) -> dist x y <= e.
Variable firm_fixed : forall k, (k < N)%nat -> firm k -> F k /\ less_on_each_side e (C k) (B k).
Variable others_fixed : forall k, (k < N)%nat -> F k -> ~ firm k -> C k = B k.
Variable points : forall k, (k < N)%nat -> ~ F k -> inside (q k) (B k) /\ exact (C k) (q k).
Variables (Fi : firm i) (Fj : firm j).

Lemma shrunk_inside k : (k < N)%nat -> F k -> refines (C k) (B k).
Proof.
  intros K H. destruct (classic (firm k)) as [T | T].
  - intros z Z. apply (around_inside e (C k) (B k) z z); [now apply firm_fixed | exact Z | rewrite dist_self; lra].
  - rewrite (others_fixed k K H T). now intros z.
Qed.

Lemma end_shrinks k c : (k < N)%nat -> firm k -> dl c (C k) <= dl c (B' k) - e.
Proof.
  intros K H. destruct (firm_fixed k K H) as [Fk L]. pose proof (dl_less e _ _ c (Rlt_le _ _ Pe) L).
  pose proof (dl_monotone c _ _ (proj2 narrow k K Fk)). lra.
Qed.

Theorem firm_refutes_legal : ~ legal N C i j -> ~ legal N B' i j.
Proof.
  intros H [c W]. apply H. exists c. intros k K Di Dj. destruct (W k K Di Dj) as [Wi Wj].
  pose proof (end_shrinks i c I Fi). pose proof (end_shrinks j c J Fj).
  assert (ds c (B' k) - e <= ds c (C k)); [| lra]. destruct (classic (F k)) as [T | T].
  - pose proof (ds_monotone c _ _ (shrunk_inside k K T)). pose proof (ds_monotone c _ _ (proj1 narrow k K)).
    pose proof (ds_monotone c _ _ (proj2 narrow k K T)). lra.
  - destruct (points k K T) as [Iq Ex]. rewrite (exact_ds c _ _ Ex).
    set (x := nearest c (B' k)). assert (Ix : inside x (B' k)) by apply nearest_inside.
    pose proof (small_ones k (q k) x K T Iq (proj1 narrow k K x Ix)). pose proof (dist_triangle c (q k) x).
    change (ds c (B' k)) with (dist c x). lra.
Qed.

Theorem firm_stays_possible : possible N C i j -> possible N B' i j.
Proof.
  assert (Same : forall k c, (k < N)%nat -> F k -> ds c (B' k) = ds c (B k) /\ dl c (B' k) = dl c (B k)).
  { intros k c K T. pose proof (ds_monotone c _ _ (proj1 narrow k K)). pose proof (ds_monotone c _ _ (proj2 narrow k K T)).
    pose proof (dl_monotone c _ _ (proj1 narrow k K)). pose proof (dl_monotone c _ _ (proj2 narrow k K T)). lra. }
  destruct (firm_fixed i I Fi) as [Ti Li]. destruct (firm_fixed j J Fj) as [Tj Lj].
  assert (E : 0 <= e) by lra. intros [[c H] | [u [U H]]].
  - left. exists c. intros k K Di Dj. destruct (H k K Di Dj) as [Hi Hj].
    destruct (Same i c I Ti) as [Si _]. destruct (Same j c J Tj) as [Sj _]. rewrite Si, Sj.
    assert (Dl : dl c (C k) - e <= dl c (B' k) /\ (F k -> dl c (C k) <= dl c (B' k))).
    { destruct (classic (F k)) as [T | T].
      - destruct (Same k c K T) as [_ ->]. pose proof (dl_monotone c _ _ (shrunk_inside k K T)). split; [lra | now intros].
      - split; [| now intros]. destruct (points k K T) as [Iq Ex]. rewrite (exact_dl c _ _ Ex).
        set (x := nearest c (B' k)). assert (Ix : inside x (B' k)) by apply nearest_inside.
        pose proof (small_ones k x (q k) K T (proj1 narrow k K x Ix) Iq). pose proof (dist_triangle c x (q k)).
        pose proof (le_dl c _ _ Ix). lra. }
    assert (Zero : forall X, inside c X -> ds c X <= 0) by (intros X X0; pose proof (ds_le c X c X0); rewrite dist_self in *; lra).
    pose proof (dl_nonneg c (B' k)). pose proof (ds_nonneg c (B i)). pose proof (ds_nonneg c (B j)).
    destruct (classic (inside c (B i))) as [Ci | Ci]; destruct (classic (inside c (B j))) as [Cj | Cj].
    + pose proof (Zero _ Ci). pose proof (Zero _ Cj). lra.
    + pose proof (Zero _ Ci). pose proof (ds_more e _ _ c E Lj Cj). lra.
    + pose proof (Zero _ Cj). pose proof (ds_more e _ _ c E Li Ci). lra.
    + pose proof (ds_more e _ _ c E Lj Cj). pose proof (ds_more e _ _ c E Li Ci). lra.
  - right. exists u. split; [exact U |]. intros s k Ls Ss K. pose proof (H s k Ls Ss K) as G.
    assert (Ts : F s /\ less_on_each_side e (C s) (B s)) by (destruct Ss as [-> | ->]; now split).
    destruct Ts as [Ts L]. pose proof (highest_more e _ _ u E U L) as Hi.
    assert (dot u (highest u (B s)) <= dot u (highest u (B' s))).
    { apply highest_spec. apply (proj2 narrow s Ls Ts). apply highest_spec. }
    assert (0 <= norm u) by apply dist_nonneg.
    assert (dot u (lowest u (B' k)) <= dot u (lowest u (C k)) + norm u * e); [| lra].
    destruct (classic (F k)) as [T | T].
    + assert (dot u (lowest u (B' k)) <= dot u (lowest u (C k))).
      { apply lowest_spec. apply (proj2 narrow k K T). apply (shrunk_inside k K T). apply lowest_spec. }
      assert (0 <= norm u * e) by now apply Rmult_le_pos. lra.
    + destruct (points k K T) as [Iq [_ Ex]]. rewrite (Ex _ (proj1 (lowest_spec u (C k)))).
      set (x := lowest u (B' k)). assert (Ix : inside x (B' k)) by apply lowest_spec.
      pose proof (small_ones k x (q k) K T (proj1 narrow k K x Ix) Iq).
      pose proof (dot_near u x (q k)). assert (norm u * dist x (q k) <= norm u * e) by (apply Rmult_le_compat_l; lra). lra.
Qed.
End Firm.
