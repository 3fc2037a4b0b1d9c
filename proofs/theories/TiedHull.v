(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* No site is beyond a tied chain of the hull [TIE-3]: a chain of legal links between two sure corners, with the hull of
   the representatives behind it, whose true points are on one line. Its pairs are weakly Delaunay, by a half-plane, and
   never strictly but for the links.

   From another site one looks at the way along the chain and back. The ends of the chain are beyond the site in
   directions that hold for every choice, so it is never on this way, which winds around it as often for the true points
   as for the representatives. *)
From Coq Require Import Reals Lra Lia Psatz ZArith List Permutation Classical.
From Dyadel Require Import Plane Distance Cells Legal Nerve Orientation Path Fan TiedRim Winding TiedPolygon TiedTree
  TiedChain TiedView.
Open Scope R_scope.

(* ---- the chain, the way out of its end straight down ---- *)

Lemma both_total c J : (forall a b, c b a = (- c a b)%Z) -> total c (flat_map both J) = 0%Z.
Proof.
  intros O. induction J as [| [a b] J IH]; [reflexivity |]. simpl flat_map. unfold total in *. simpl.
  rewrite IH, (O a b). lia.
Qed.

Lemma walk_reversed a E z : walk a E z -> walk z (rev (reversed E)) a.
Proof.
  revert a. induction E as [| [x y] E IH]; intros a W; [simpl in *; now symmetry |]. destruct W as [<- W].
  simpl. apply walk_app. exists y. split; [now apply IH | now split].
Qed.

Lemma between_orient z a b : between z a b -> orient a b z = 0.
Proof. intros [r [_ ->]]. unfold orient, mix. simpl. ring. Qed.

Section Chain.
(* p: the representatives, q: the true points. T: the triangles of the face; E: its links, from f to l; from l to h, and
   by H to f: the edges of the hull of its ghost triangles. m: any other site; u: it is never beyond f in this direction. *)
Variables (N : nat) (p q : nat -> point) (T : list (nat * nat * nat)) (E H J : list (nat * nat)) (f l h m : nat).
Variable u : point.
Variable links : walk f E l.
Variable back : walk h H f.
Variable face : Permutation (flat_map sides T ++ reversed ((l, h) :: H)) (E ++ flat_map both J).
Variable below_f : (f < N)%nat.
Variable below_l : (l < N)%nat.
Variable below_hull : forall a b, In (a, b) ((l, h) :: H) -> (a < N)%nat /\ (b < N)%nat.
Variable below_links : forall a b, In (a, b) E -> (a < N)%nat /\ (b < N)%nat.
Variable triangles : forall a b c, In (a, b, c) T -> 0 < orient (p a) (p b) (p c) /\
  ~ (0 <= orient (p a) (p b) (p m) /\ 0 <= orient (p b) (p c) (p m) /\ 0 <= orient (p c) (p a) (p m)).
Variable inner : forall a b, In (a, b) ((l, h) :: H) ->
  0 < orient (p a) (p b) (p m) /\ 0 <= orient (p a) (p b) (p l).
Variable lowest : forall a b, In (a, b) H -> snd (p l) < snd (p a) /\ snd (p l) < snd (p b).
Variable lowest_h : snd (p l) < snd (p h).
Variable start : snd (p l) < snd (p m) /\ snd (p l) < snd (p f) /\ dot u (p m) < dot u (p f) /\ dot u (p l) < dot u (p f).
Variable stop : snd (q l) < snd (q m) /\ snd (q l) < snd (q f) /\ dot u (q m) < dot u (q f) /\ dot u (q l) < dot u (q f).
Variable free : forall t a b, 0 <= t <= 1 -> In (a, b) E ->
  ~ between (mix t (p m) (q m)) (mix t (p a) (q a)) (mix t (p b) (q b)).
Variable line : forall a b, In (a, b) E -> orient (q f) (q l) (q a) = 0 /\ orient (q f) (q l) (q b) = 0.

Let n : point := (snd (q f) - snd (q l), fst (q l) - fst (q f)).
Let path := (l, h) :: H.

Lemma n_right : 0 < fst n.
Proof. unfold n. simpl. lra. Qed.

Lemma n_before_u : 0 < turn n u.
Proof.
  replace (turn n u) with (dot u (q f) - dot u (q l)) by (unfold turn, dot, n; simpl; ring). lra.
Qed.

Lemma links_as_hull : total (fun a b => passes (p m) (p a) (p b)) E =
  total (fun a b => passes (p m) (p a) (p b)) (rev (reversed path)).
Proof.
  pose proof (total_permuted (fun a b => passes (p m) (p a) (p b)) _ _ face) as P. rewrite !total_app in P.
  rewrite (both_total _ J) in P by (intros; apply passes_back).
  assert (Z : total (fun a b => passes (p m) (p a) (p b)) (flat_map sides T) = 0%Z).
  { apply (rim_around T (flat_map sides T) p (p m)); [exists nil; now rewrite app_nil_r | exact triangles]. }
  rewrite Z in P. rewrite <- (total_permuted _ _ _ (Permutation_rev (reversed path))). unfold path. lia.
Qed.

(* From the representative of m to l. *)
Lemma on_the_way_inner s : 0 <= s < 1 -> let z := mix s (p m) (p l) in
  snd (p l) < snd z /\ dot u z < dot u (p f) /\ forall a b, In (a, b) path -> 0 < orient (p a) (p b) z.
Proof.
  intros S z. split; [| split].
  - assert (X : snd z - snd (p l) = (1 - s) * (snd (p m) - snd (p l))) by (unfold z, mix; simpl; ring).
    assert (0 < (1 - s) * (snd (p m) - snd (p l))) by (apply Rmult_lt_0_compat; lra). lra.
  - assert (X : dot u (p f) - dot u z = (1 - s) * (dot u (p f) - dot u (p m)) + s * (dot u (p f) - dot u (p l)))
      by (unfold z, dot, mix; simpl; ring).
    assert (0 < (1 - s) * (dot u (p f) - dot u (p m))) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= s * (dot u (p f) - dot u (p l))) by (apply Rmult_le_pos; lra). lra.
  - intros a b F. destruct (inner a b F) as [X Y].
    replace (orient (p a) (p b) z) with ((1 - s) * orient (p a) (p b) (p m) + s * orient (p a) (p b) (p l))
      by (unfold z, orient, mix; simpl; ring).
    assert (0 < (1 - s) * orient (p a) (p b) (p m)) by (apply Rmult_lt_0_compat; lra).
    assert (0 <= s * orient (p a) (p b) (p l)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma next_to_l : exists r, 0 <= r < 1 /\ snd (mix r (p m) (p l)) < snd (p h) /\ snd (mix r (p m) (p l)) < snd (p f) /\
  forall a b, In (a, b) H -> snd (mix r (p m) (p l)) < snd (p a) /\ snd (mix r (p m) (p l)) < snd (p b).
Proof.
  assert (One : forall v, snd (p l) < snd (p v) -> near 1 (fun s => snd (mix s (p m) (p l)) < snd (p v))).
  { intros v V. apply (near_less (fun s => snd (mix s (p m) (p l))) (fun _ => snd (p v))).
    - unfold mix. simpl. reg.
    - apply continuity_const. now intros ? ?.
    - now rewrite mix_1. }
  assert (K : near 1 (fun s => forall e, In e H ->
    snd (mix s (p m) (p l)) < snd (p (fst e)) /\ snd (mix s (p m) (p l)) < snd (p (snd e)))).
  { apply near_list. intros [a b] F. destruct (lowest a b F). apply near_and; now apply One. }
  destruct (near_and _ _ _ K (near_and _ _ _ (One h lowest_h) (One f ltac:(lra)))) as [e [E0 Ke]].
  pose proof (Rmin_l e (1 / 2)) as M1. pose proof (Rmin_r e (1 / 2)) as M2.
  assert (M0 : 0 < Rmin e (1 / 2)) by (apply Rmin_pos; lra). exists (1 - Rmin e (1 / 2)).
  destruct (Ke (1 - Rmin e (1 / 2))) as [A [C D]]; [rewrite Rabs_left; lra |].
  split; [lra |]. split; [exact C |]. split; [exact D |]. intros a b F. exact (A (a, b) F).
Qed.

Lemma winds_not_at_start :
  (total (fun a b => passes (p m) (p a) (p b)) E + way_back n u (p m) (p f) (p l) = 0)%Z.
Proof.
  destruct next_to_l as [r [R [Rh [Rf Rv]]]]. rewrite links_as_hull. set (around := rev (reversed path)).
  assert (Sw : forall a b, In (a, b) around -> In (b, a) path).
  { intros a b F. apply in_rev in F. apply in_map_iff in F as [[x y] [Q F]]. simpl in Q. now injection Q as <- <-. }
  pose proof (view_steady N around f l n u (fun v _ => p v) (fun s => mix (s * r) (p m) (p l))) as W.
  cbv beta zeta in W. rewrite Rmult_0_l, Rmult_1_l, mix_0 in W.
  assert (Way : forall t, 0 <= t <= 1 -> 0 <= t * r < 1).
  { intros t S. split; [apply Rmult_le_pos; lra |]. assert (t * r <= 1 * r) by (apply Rmult_le_compat_r; lra). lra. }
  rewrite <- W; clear W.
  - destruct (on_the_way_inner r R) as [Z1 [Z2 Z3]]. set (z := mix r (p m) (p l)) in *.
    unfold around. rewrite (total_permuted _ _ _ (Permutation_sym (Permutation_rev (reversed path)))), total_reversed.
    rewrite (total_same _ (fun a b => (- passes z (p a) (p b))%Z)) by (intros; apply passes_back).
    rewrite (total_opposite (fun a b => passes z (p a) (p b))).
    assert (S : total (fun a b => passes z (p a) (p b)) path =
      (passes z (p l) (p h) + (right z (p f) - right z (p h)))%Z).
    { rewrite <- (total_walk (fun v => right z (p v)) h H f back). unfold path, total at 1. simpl. f_equal.
      apply (total_same (fun a b => passes z (p a) (p b))). intros a b F. destruct (Rv a b F). now apply ends_above. }
    rewrite S, (winds_not_next_to n u z (p f) (p l) (p h)); try assumption; try lia;
      [apply n_right | apply n_before_u | apply Z3; now left].
  - apply walk_reversed. now split.
  - exact below_f.
  - exact below_l.
  - intros a b F. now apply and_comm, below_hull, Sw.
  - intros v. split; apply continuity_const; now intros ? ?.
  - unfold mix. simpl. split; reg.
  - apply n_right.
  - apply n_before_u.
  - intros t S. destruct (on_the_way_inner (t * r) (Way t S)) as [Z1 [Z2 _]]. now split.
  - intros t a b S F Bt. destruct (on_the_way_inner (t * r) (Way t S)) as [_ [_ Z3]].
    specialize (Z3 b a (Sw a b F)). apply between_orient in Bt.
    assert (orient (p b) (p a) (mix (t * r) (p m) (p l)) = - orient (p a) (p b) (mix (t * r) (p m) (p l)))
      by (unfold orient; ring). lra.
Qed.

Theorem nobody_beyond : orient (q f) (q l) (q m) <= 0.
Proof.
  apply Rnot_lt_le. intros O.
  assert (W : (total (fun a b => passes (q m) (q a) (q b)) E + way_back n u (q m) (q f) (q l) = 0)%Z).
  { rewrite <- winds_not_at_start.
    pose proof (view_steady N E f l n u (fun v s => mix s (p v) (q v)) (fun s => mix s (p m) (q m))) as W.
    assert (M1 : forall v, mix 1 (p v) (q v) = q v) by (intros; apply mix_1).
    assert (M0 : forall v, mix 0 (p v) (q v) = p v) by (intros; apply mix_0).
    cbv beta zeta in W. rewrite !M1, !M0 in W.
    rewrite (total_same _ (fun a b => passes (q m) (q a) (q b))) in W by (intros; now rewrite !M1).
    rewrite (total_same (fun a b => passes (p m) (mix 0 (p a) (q a)) (mix 0 (p b) (q b)))
      (fun a b => passes (p m) (p a) (p b))) in W by (intros; now rewrite !M0).
    apply W; try assumption.
    - intros v. unfold mix. simpl. split; reg.
    - unfold mix. simpl. split; reg.
    - apply n_right.
    - apply n_before_u.
    - intros t S. unfold dot, mix in *. simpl. destruct start as [A1 [_ [A3 _]]]. destruct stop as [C1 [_ [C3 _]]].
      destruct (Req_dec t 0) as [-> | T0]; [lra |].
      assert (0 < t * (snd (q m) - snd (q l))) by (apply Rmult_lt_0_compat; lra).
      assert (0 <= (1 - t) * (snd (p m) - snd (p l))) by (apply Rmult_le_pos; lra).
      assert (0 < t * (dot u (q f) - dot u (q m))) by (apply Rmult_lt_0_compat; unfold dot; lra).
      assert (0 <= (1 - t) * (dot u (p f) - dot u (p m))) by (apply Rmult_le_pos; unfold dot; lra).
      unfold dot in *. lra. }
  rewrite (winds_not_beside_line E f l q (q m) links ltac:(lra) line) in W.
  destruct stop as [C1 [C2 [C3 C4]]].
  pose proof (winds_beyond n u (q m) (q f) (q l) n_right n_before_u C1 C2 C3 C4 O). lia.
Qed.
End Chain.

(* ---- in any direction ---- *)

(* Turned so that w is straight down. *)
Definition look (w v : point) : point := (turn w v, - dot w v).

Lemma look_mix w t a b : look w (mix t a b) = mix t (look w a) (look w b).
Proof. unfold look, mix, turn, dot. simpl. f_equal; ring. Qed.

Lemma look_orient w a b c : orient (look w a) (look w b) (look w c) = dot w w * orient a b c.
Proof. unfold orient, look, turn, dot. simpl. ring. Qed.

Lemma look_dot w a b : dot (look w a) (look w b) = dot w w * dot a b.
Proof. unfold look, turn, dot. simpl. ring. Qed.

Lemma look_between w z a b : 0 < dot w w -> between (look w z) (look w a) (look w b) -> between z a b.
Proof.
  intros P [t [S Z]]. exists t. split; [exact S |]. rewrite <- look_mix in Z. set (y := mix t a b) in *.
  unfold look in Z. assert (X : turn w z = turn w y) by exact (f_equal fst Z).
  assert (Y : - dot w z = - dot w y) by exact (f_equal snd Z).
  apply (scaled_point_eq (dot w w)); [lra | |]; apply Rminus_diag_uniq.
  - transitivity (fst w * (dot w z - dot w y) - snd w * (turn w z - turn w y));
      [unfold dot, turn; ring | rewrite X; replace (dot w z) with (dot w y) by lra; ring].
  - transitivity (snd w * (dot w z - dot w y) + fst w * (turn w z - turn w y));
      [unfold dot, turn; ring | rewrite X; replace (dot w z) with (dot w y) by lra; ring].
Qed.

(* A chain of legal links between two sure corners, its true points on one line; at the representatives, between it and
   the hull's edges from l back to f, nothing but triangles without another site: all true points are on one closed side
   of the line, and all pairs of the chain are weakly Delaunay. *)
Definition on_chain (E : list (nat * nat)) (v : nat) : Prop := exists b, In (v, b) E \/ In (b, v) E.

Section Hull.
Variables (N : nat) (B : sites) (p q : nat -> point) (T : list (nat * nat * nat)) (E H J : list (nat * nat)).
Variables (f l h : nat).
Variable drawn : choice N B p.
Variable true_points : choice N B q.
Variable links : walk f E l.
Variable back : walk h H f.
Variable face : Permutation (flat_map sides T ++ reversed ((l, h) :: H)) (E ++ flat_map both J).
Variable ends : f <> l /\ sure_hull N B f /\ sure_hull N B l.
Variable legal_links : forall a b, In (a, b) E -> (a < N)%nat /\ (b < N)%nat /\ a <> b /\ legal N B a b.
Variable hull : forall a b, In (a, b) ((l, h) :: H) -> (a < N)%nat /\ (b < N)%nat /\ b <> l /\
  0 <= orient (p a) (p b) (p l) /\ forall m, (m < N)%nat -> ~ on_chain E m -> 0 < orient (p a) (p b) (p m).
Variable once : forall a b, In (a, b) H -> a <> l.
Variable triangles : forall a b c, In (a, b, c) T -> 0 < orient (p a) (p b) (p c) /\
  forall m, (m < N)%nat -> ~ on_chain E m ->
    ~ (0 <= orient (p a) (p b) (p m) /\ 0 <= orient (p b) (p c) (p m) /\ 0 <= orient (p c) (p a) (p m)).
Variable line : forall v, on_chain E v -> orient (q f) (q l) (q v) = 0.

Lemma chain_ends : (exists b, In (f, b) E) /\ (exists b, In (b, l) E).
Proof.
  destruct ends as [D _]. split.
  - destruct E as [| [x y] F]; [now elim D |]. destruct links as [-> _]. exists y. now left.
  - pose proof (walk_reversed f E l links) as W. destruct (rev (reversed E)) as [| [x y] F] eqn:Er.
    + simpl in W. now elim D.
    + destruct W as [-> _]. exists y. assert (X : In (l, y) (rev (reversed E))) by (rewrite Er; now left).
      apply in_rev in X. apply in_map_iff in X as [[a b] [Q X]]. simpl in Q. now injection Q as <- <-.
Qed.

Theorem chain_side m : (m < N)%nat -> orient (q f) (q l) (q m) <= 0.
Proof.
  intros M. destruct (classic (on_chain E m)) as [On | On]; [rewrite (line m On); lra |].
  destruct ends as [D [[u U] [w W]]]. destruct chain_ends as [[fb Fb] [lb Lb]].
  destruct (legal_links f fb Fb) as [Lf _]. destruct (legal_links lb l Lb) as [_ [Ll _]].
  assert (Mf : m <> f) by (intros ->; apply On; exists fb; now left).
  assert (Ml : m <> l) by (intros ->; apply On; exists lb; now right).
  assert (Wd : forall x, choice N B x -> forall k, (k < N)%nat -> k <> l -> dot w (x k) < dot w (x l))
    by (intros x X k K Dk; apply (W k); auto).
  assert (Ud : forall x, choice N B x -> forall k, (k < N)%nat -> k <> f -> dot u (x k) < dot u (x f))
    by (intros x X k K Dk; apply (U k); auto).
  assert (P : 0 < dot w w).
  { pose proof (Wd q true_points f Lf D) as X. unfold dot in *. destruct (Req_dec (fst w) 0) as [F | F]; [| nra].
    destruct (Req_dec (snd w) 0) as [G | G]; [| nra]. rewrite F, G in X. lra. }
  assert (Sn : forall a b, dot w b < dot w a -> snd (look w a) < snd (look w b)) by (intros; unfold look; simpl; lra).
  assert (Dt : forall a b, dot u a < dot u b -> dot (look w u) (look w a) < dot (look w u) (look w b)).
  { intros a b X. rewrite !look_dot. now apply Rmult_lt_compat_l. }
  assert (Pos : forall a b c, 0 < orient a b c -> 0 < orient (look w a) (look w b) (look w c))
    by (intros; rewrite look_orient; now apply Rmult_lt_0_compat).
  assert (Inv : forall a b c, 0 <= orient (look w a) (look w b) (look w c) -> 0 <= orient a b c).
  { intros a b c X. rewrite look_orient in X. apply (Rmult_le_reg_l (dot w w)); lra. }
  apply (Rmult_le_reg_l (dot w w)); [exact P |]. rewrite <- look_orient, Rmult_0_r.
  apply (nobody_beyond N (fun v => look w (p v)) (fun v => look w (q v)) T E H J f l h m (look w u));
    try assumption.
  - intros a b F. now destruct (hull a b F) as [X [Y _]].
  - intros a b F. now destruct (legal_links a b F) as [X [Y _]].
  - intros a b c F. destruct (triangles a b c F) as [X Y]. split; [now apply Pos |]. intros [A [C G]].
    apply (Y m M On). repeat split; now apply Inv.
  - intros a b F. destruct (hull a b F) as [_ [_ [_ [X Y]]]]. split; [now apply Pos, Y |]. rewrite look_orient.
    apply Rmult_le_pos; lra.
  - intros a b F. destruct (hull a b (or_intror F)) as [X [Y [Z _]]].
    split; apply Sn, Wd; auto. now apply once with b.
  - destruct (hull l h (or_introl eq_refl)) as [_ [Y [Z _]]]. now apply Sn, Wd.
  - repeat split; [apply Sn, Wd | apply Sn, Wd | apply Dt, Ud | apply Dt, Ud]; auto.
  - repeat split; [apply Sn, Wd | apply Sn, Wd | apply Dt, Ud | apply Dt, Ud]; auto.
  - intros t a b S F Bt. rewrite <- !look_mix in Bt. apply look_between in Bt; [| exact P].
    destruct (legal_links a b F) as [La [Lb' [_ Le]]]. revert Bt.
    apply (edge_is_free N (fun v => mix t (p v) (q v)) a b m M).
    + intros ->. apply On. exists b. now left.
    + intros ->. apply On. exists a. now right.
    + apply (legal_sound N B); try assumption. intros k K. apply inside_convex; auto.
  - intros a b F. split; rewrite look_orient, line; try ring; [exists b; now left | exists a; now right].
Qed.

Lemma normal : exists n, n <> (0, 0) /\ forall v, dot n (q v) - dot n (q f) = orient (q f) (q l) (q v).
Proof.
  destruct ends as [D [_ [w W]]]. destruct chain_ends as [[fb Fb] [lb Lb]].
  destruct (legal_links f fb Fb) as [Lf _]. destruct (legal_links lb l Lb) as [_ [Ll _]].
  exists (snd (q f) - snd (q l), fst (q l) - fst (q f)).
  split; [| intros; unfold dot, orient; simpl; ring]. intros Z.
  pose proof (f_equal fst Z) as X. pose proof (f_equal snd Z) as Y. simpl in X, Y.
  pose proof (W f (q l) (q f) Lf D (true_points l Ll) (true_points f Lf)) as K.
  replace (q l) with (q f) in K; [lra |]. rewrite (surjective_pairing (q f)), (surjective_pairing (q l)). f_equal; lra.
Qed.

Theorem chain_pairs_weak i j : on_chain E i -> on_chain E j -> weak_edge N q i j.
Proof.
  intros Ci Cj. destruct normal as [n [Nz Dot]]. right. exists n, (dot n (q f)). split; [exact Nz |]. split.
  - intros k _ [-> | ->]; [pose proof (line i Ci) | pose proof (line j Cj)]; rewrite <- Dot in *; lra.
  - intros k K. pose proof (chain_side k K) as X. rewrite <- Dot in X. lra.
Qed.

(* Two links at least, all vertices different. *)
Variable several : (2 <= length E)%nat.
Variable different : NoDup (f :: map snd E).
Let at_ (k : nat) : nat := nth k (f :: map snd E) 0%nat.

Lemma walk_nth a F z k : walk a F z -> (k < length F)%nat ->
  In (nth k (a :: map snd F) 0%nat, nth (S k) (a :: map snd F) 0%nat) F.
Proof.
  revert a k. induction F as [| [x y] F IH]; intros a k W K; [simpl in K; lia |]. destruct W as [-> W].
  destruct k as [| k]; [now left |]. right. apply (IH y k W). simpl in K. lia.
Qed.

Lemma walk_from a F z x b : walk a F z -> In (x, b) F -> In x (a :: map snd F).
Proof.
  revert a. induction F as [| [c y] F IH]; intros a W G; [destruct G |]. destruct W as [-> W].
  destruct G as [G | G]; [injection G as <- <-; now left | right; now apply IH].
Qed.

Lemma on_chain_at v : on_chain E v -> exists k, (k < S (length E))%nat /\ at_ k = v.
Proof.
  intros C. assert (X : In v (f :: map snd E)).
  { destruct C as [b [F | F]]; [now apply (walk_from f E l v b) | right; apply in_map_iff; now exists (b, v)]. }
  apply (In_nth _ _ 0%nat) in X as [k [K Q]]. simpl in K. rewrite map_length in K. now exists k.
Qed.

Lemma at_on_chain k : (k < S (length E))%nat -> on_chain E (at_ k).
Proof.
  intros K. destruct k as [| k].
  - destruct chain_ends as [[b F] _]. exists b. now left.
  - exists (at_ k). right. apply (walk_nth f E l k links). lia.
Qed.

Theorem chain_pairs_not_strict i j : on_chain E i -> on_chain E j -> i <> j -> ~ In (i, j) E -> ~ In (j, i) E ->
  ~ strict_edge N q i j.
Proof.
  intros Ci Cj D Nij Nji. destruct (on_chain_at i Ci) as [a [A <-]]. destruct (on_chain_at j Cj) as [b [Bb <-]].
  assert (Below : forall k, (k < S (length E))%nat -> (at_ k < N)%nat).
  { intros k K. destruct (at_on_chain k K) as [c [F | F]]; now destruct (legal_links _ _ F) as [X [Y _]]. }
  assert (Apart : forall x y, (x < S (length E))%nat -> (y < S (length E))%nat -> at_ x = at_ y -> x = y).
  { intros x y X Y Q. apply (proj1 (NoDup_nth (f :: map snd E) 0%nat) different); [| | exact Q];
      simpl; rewrite map_length; assumption. }
  assert (Links : forall k, (S k < S (length E))%nat -> legal N B (at_ k) (at_ (S k))).
  { intros k K. apply (legal_links _ _ (walk_nth f E l k links ltac:(lia))). }
  assert (Line : forall x y k, (x < S (length E))%nat -> (y < S (length E))%nat -> (k < S (length E))%nat ->
    orient (q (at_ x)) (q (at_ y)) (q (at_ k)) = 0).
  { intros x y k X Y K. destruct normal as [n [Nz Dot]].
    assert (H0 : forall s, (s < S (length E))%nat -> dot n (q (at_ s)) = dot n (q f)).
    { intros s S0. pose proof (line _ (at_on_chain s S0)) as Z. rewrite <- Dot in Z. lra. }
    apply (collinear n); [exact Nz | |]; now rewrite !H0. }
  destruct (Nat.lt_trichotomy a b) as [L | [-> | L]]; [| now elim D |].
  - assert (S a <> b).
    { intros <-. apply Nij. apply (walk_nth f E l a links). lia. }
    now apply (chain_not_strict N B q at_ (S (length E)) true_points ltac:(lia) Below Apart Links Line a b ltac:(lia)).
  - assert (S b <> a).
    { intros <-. apply Nji. apply (walk_nth f E l b links). lia. }
    now apply (chain_not_strict N B q at_ (S (length E)) true_points ltac:(lia) Below Apart Links Line b a ltac:(lia)).
Qed.
End Hull.
