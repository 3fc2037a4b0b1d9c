(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* All points move straight from p to q. While no edge of a triangulation is lost, and no corner of the hull comes between
   its neighbours, nothing changes: edges stay, and no other pair becomes one. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Cells Legal Nerve Orientation Disc TiedFace Path Fan Triangulation
  ToleranceNear.
Open Scope R_scope.

(* A triangulation of the points p: round each site a its triangles a, i, j, counterclockwise, without a further site in
   them; each side belongs to the next triangle too or to the rim, which goes round the hull counterclockwise. *)
Record skeleton (N : nat) (p : nat -> point) (faces : nat -> list (nat * nat)) (rim edge : nat -> nat -> Prop) : Prop := {
  some_face : forall a, (a < N)%nat -> faces a <> nil;
  face_sites : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> (i < N)%nat /\ (j < N)%nat /\ i <> a /\ j <> a /\ i <> j;
  face_edges : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> edge a i /\ edge a j /\ edge i j;
  face_left : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> 0 < orient (p a) (p i) (p j);
  face_empty : forall a i j m, (a < N)%nat -> In (i, j) (faces a) -> (m < N)%nat -> m <> a -> m <> i -> m <> j ->
    ~ (0 <= orient (p a) (p i) (p m) /\ 0 <= orient (p a) (p m) (p j) /\ 0 <= orient (p i) (p j) (p m));
  face_before : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> (exists l, In (l, i) (faces a)) \/ rim a i;
  face_after : forall a i j, (a < N)%nat -> In (i, j) (faces a) -> (exists l, In (j, l) (faces a)) \/ rim j a;
  rim_sites : forall u v, rim u v -> (u < N)%nat /\ (v < N)%nat /\ u <> v /\ edge u v;
  rim_goes_on : forall u v, rim u v -> (exists w, rim v w) /\ (exists t, rim t u);
  rim_turns : forall u v w, rim u v -> rim v w -> u <> w;
  rim_left : forall u v k, rim u v -> (k < N)%nat -> 0 <= orient (p u) (p v) (p k) }.

Lemma nonzero_stays f t : continuity f -> 0 < f 0 -> (forall s, 0 <= s <= 1 -> f s <> 0) -> 0 <= t <= 1 -> 0 < f t.
Proof.
  intros C F H T. apply Rnot_le_lt. intros Y.
  destruct (intermediate (fun s => - f (t * s))) as [s [S E]].
  - apply (continuity_opp (fun s => f (t * s))), (continuity_comp (fun s => t * s) f); [reg | exact C].
  - rewrite Rmult_0_r. lra.
  - rewrite Rmult_1_r. lra.
  - apply (H (t * s)); [nra | lra].
Qed.

(* A point of a closed triangle that is on the line of a side is on the side. *)
Lemma on_side a i j m : 0 < orient a i j -> orient a i m = 0 -> 0 <= orient a m j -> 0 <= orient i j m -> between m a i.
Proof.
  intros D Z A B. pose proof (bary_sum a i j m) as S. pose proof (bary_x a i j m) as X. pose proof (bary_y a i j m) as Y.
  set (d := orient a i j) in *. set (k := orient a m j / d).
  assert (I : orient a m j = k * d) by (unfold k; field; lra).
  assert (O : orient i j m = d - k * d) by lra. rewrite I in A. rewrite O in B.
  exists k. split; [split; nra |]. apply (scaled_point_eq d); [lra | |].
  - rewrite X, Z, I, O. unfold mix. simpl. ring.
  - rewrite Y, Z, I, O. unfold mix. simpl. ring.
Qed.

(* Beyond v on the line from u, a point is on the wrong side of the way on from v. *)
Lemma beyond_turn u v w k s : v = mix s u k -> s * orient v w k = - (1 - s) * orient u v w.
Proof. intros ->. unfold orient, mix. simpl. ring. Qed.

Lemma before_turn t u v k s : u = mix s v k -> s * orient t u k = - (1 - s) * orient t u v.
Proof. intros ->. unfold orient, mix. simpl. ring. Qed.

Definition at_point (z : point) : rect := Rect (fst z) (fst z) (snd z) (snd z) (Rle_refl _) (Rle_refl _).

Lemma at_point_exact z : exact (at_point z) z.
Proof.
  split; [unfold inside; simpl; lra |]. intros w [X Y]. simpl in X, Y.
  rewrite (surjective_pairing w), (surjective_pairing z). f_equal; lra.
Qed.

Lemma strict_edge_legal N q i j : strict_edge N q i j -> legal N (fun k => at_point (q k)) i j.
Proof.
  intros [o [E H]]. exists o. intros k K Di Dj.
  rewrite !(exact_dl o _ _ (at_point_exact _)), (exact_ds o _ _ (at_point_exact _)).
  pose proof (H k K Di Dj). lra.
Qed.

Lemma at_points_choice N q : choice N (fun k => at_point (q k)) q.
Proof. intros k _. apply at_point_exact. Qed.

Section Move.
Variables (N : nat) (p q : nat -> point) (faces : nat -> list (nat * nat)) (rim edge : nat -> nat -> Prop).
Variable sk : skeleton N p faces rim edge.
Let x (t : R) (k : nat) : point := path p q t k.
Variable edges_stay : forall t i j, 0 <= t <= 1 -> edge i j -> strict_edge N (x t) i j.
Variable corners_stay : forall t u v w, 0 <= t <= 1 -> rim u v -> rim v w -> ~ between (x t v) (x t u) (x t w).

Lemma at_0 k : x 0 k = p k.
Proof. apply mix_0. Qed.

Lemma turn_continuous i j k : continuity (fun t => orient (x t i) (x t j) (x t k)).
Proof. unfold x. apply path_orient_continuous. Qed.

Lemma edge_free t i j k : 0 <= t <= 1 -> edge i j -> (k < N)%nat -> k <> i -> k <> j -> ~ between (x t k) (x t i) (x t j).
Proof. intros T E K Di Dj. apply edge_is_free with N; try assumption. now apply edges_stay. Qed.

Lemma faces_left t a i j : 0 <= t <= 1 -> (a < N)%nat -> In (i, j) (faces a) -> 0 < orient (x t a) (x t i) (x t j).
Proof.
  intros T A F. destruct (face_sites _ _ _ _ _ sk a i j A F) as [I [J [Dia [Dja Dij]]]].
  destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei [Ej Eij]].
  apply (nonzero_stays (fun t => orient (x t a) (x t i) (x t j))); [apply turn_continuous | | | exact T].
  - rewrite !at_0. now apply (face_left _ _ _ _ _ sk).
  - intros s S Z. destruct (one_between _ _ _ Z) as [X | [X | X]]; revert X; apply edge_free; auto.
Qed.

Lemma corners_left t u v w : 0 <= t <= 1 -> rim u v -> rim v w -> 0 < orient (x t u) (x t v) (x t w).
Proof.
  intros T Ruv Rvw. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv Euv]]].
  destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W [Dvw Evw]]]. pose proof (rim_turns _ _ _ _ _ sk u v w Ruv Rvw) as Duw.
  assert (Nz : forall s, 0 <= s <= 1 -> orient (x s u) (x s v) (x s w) <> 0).
  { intros s S Z. destruct (one_between _ _ _ Z) as [X | [X | X]]; revert X.
    - now apply edge_free.
    - now apply corners_stay.
    - apply edge_free; auto. }
  apply (nonzero_stays (fun t => orient (x t u) (x t v) (x t w))); [apply turn_continuous | | exact Nz | exact T].
  pose proof (rim_left _ _ _ _ _ sk u v w Ruv W) as L. pose proof (Nz 0 ltac:(lra)) as Z. rewrite !at_0 in *. lra.
Qed.

(* The rim stays convex: where all are on one side of its sides, they are strictly. *)
Definition rim_weak (t : R) : Prop := forall u v k, rim u v -> (k < N)%nat -> 0 <= orient (x t u) (x t v) (x t k).
Definition rim_strict (t : R) : Prop := forall u v k, rim u v -> (k < N)%nat -> k <> u -> k <> v ->
  0 < orient (x t u) (x t v) (x t k).

Lemma rim_strictly t : 0 <= t <= 1 -> rim_weak t -> rim_strict t.
Proof.
  intros T W u v k Ruv K Du Dv. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv Euv]]].
  destruct (rim_goes_on _ _ _ _ _ sk u v Ruv) as [[w Rvw] [b Rbu]].
  destruct (Rle_lt_or_eq_dec _ _ (W u v k Ruv K)) as [L | Z]; [exact L | exfalso]. symmetry in Z.
  pose proof (edge_free t u v k T Euv K Du Dv) as Free.
  destruct (one_between _ _ _ Z) as [[s [S E]] | [[s [S E]] | X]]; [| | now apply Free].
  - pose proof (before_turn (x t b) _ _ _ s E) as B. pose proof (corners_left t b u v T Rbu Ruv) as C.
    pose proof (W b u k Rbu K) as Y. destruct (Req_dec s 1) as [-> | S1].
    + rewrite mix_1 in E. apply Free. exists 0. split; [lra |]. now rewrite mix_0.
    + assert (0 < (1 - s) * orient (x t b) (x t u) (x t v)) by (apply Rmult_lt_0_compat; lra).
      assert (0 <= s * orient (x t b) (x t u) (x t k)) by (apply Rmult_le_pos; lra). lra.
  - pose proof (beyond_turn _ _ (x t w) _ s E) as B. pose proof (corners_left t u v w T Ruv Rvw) as C.
    pose proof (W v w k Rvw K) as Y. destruct (Req_dec s 1) as [-> | S1].
    + rewrite mix_1 in E. apply Free. exists 1. split; [lra |]. now rewrite mix_1.
    + assert (0 < (1 - s) * orient (x t u) (x t v) (x t w)) by (apply Rmult_lt_0_compat; lra).
      assert (0 <= s * orient (x t v) (x t w) (x t k)) by (apply Rmult_le_pos; lra). lra.
Qed.

Lemma rim_strict_weak t : rim_strict t -> rim_weak t.
Proof.
  intros H u v k R K. destruct (Nat.eq_dec k u) as [-> | Du]; [unfold orient; lra |].
  destruct (Nat.eq_dec k v) as [-> | Dv]; [unfold orient; lra |]. left. now apply H.
Qed.

Lemma rim_stays : rim_strict 1.
Proof.
  apply open_closed.
  - apply rim_strictly; [lra |]. intros u v k R K. rewrite !at_0. now apply (rim_left _ _ _ _ _ sk).
  - intros t T H.
    assert (X : near t (fun s => forall u, (u < N)%nat -> forall v, (v < N)%nat -> forall k, (k < N)%nat ->
      rim u v -> k <> u -> k <> v -> 0 < orient (x s u) (x s v) (x s k))).
    { apply all_near. intros u U. apply all_near. intros v V. apply all_near. intros k K.
      destruct (classic (rim u v /\ k <> u /\ k <> v)) as [[R [Du Dv]] | D].
      - pose proof (near_positive _ t (turn_continuous u v k) (H u v k R K Du Dv)) as Y. revert Y. now apply near_weaken.
      - exists 1. split; [lra |]. intros s _ R Du Dv. now elim D. }
    destruct X as [e [E G]]. exists e. split; [exact E |]. intros s S _ u v k R K.
    destruct (rim_sites _ _ _ _ _ sk u v R) as [U [V _]]. now apply (G s S u U v V k K).
  - intros t T H.
    assert (X : exists u v k, rim u v /\ (k < N)%nat /\ orient (x t u) (x t v) (x t k) < 0).
    { apply NNPP. intros Ne. apply H, rim_strictly; [exact T |]. intros u v k R K. apply Rnot_lt_le. intros L.
      apply Ne. now exists u, v, k. }
    destruct X as [u [v [k [R [K L]]]]].
    destruct (near_negative _ t (turn_continuous u v k) L) as [e [E G]]. exists e. split; [exact E |].
    intros s S _ Y. pose proof (G s S). pose proof (rim_strict_weak s Y u v k R K). lra.
Qed.

(* No site enters a face. *)
Definition in_face (t : R) (a i j m : nat) : Prop :=
  0 <= orient (x t a) (x t i) (x t m) /\ 0 <= orient (x t a) (x t m) (x t j) /\ 0 <= orient (x t i) (x t j) (x t m).

Lemma faces_stay_empty a i j m : (a < N)%nat -> In (i, j) (faces a) -> (m < N)%nat -> m <> a -> m <> i -> m <> j ->
  ~ in_face 1 a i j m.
Proof.
  intros A F M Da Di Dj. destruct (face_sites _ _ _ _ _ sk a i j A F) as [I [J [Dia [Dja Dij]]]].
  destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei [Ej Eij]].
  apply (open_closed (fun t => ~ in_face t a i j m)).
  - unfold in_face. rewrite !at_0. now apply (face_empty _ _ _ _ _ sk a i j m).
  - intros t T H.
    destruct (Rle_dec 0 (orient (x t a) (x t i) (x t m))) as [O1 | O1];
      [destruct (Rle_dec 0 (orient (x t a) (x t m) (x t j))) as [O2 | O2];
        [destruct (Rle_dec 0 (orient (x t i) (x t j) (x t m))) as [O3 | O3]; [now elim H |] |] |].
    + destruct (near_negative _ t (turn_continuous i j m) (Rnot_le_lt _ _ O3)) as [e [E G]]. exists e. split; [exact E |].
      intros s S _ [_ [_ Y]]. pose proof (G s S). lra.
    + destruct (near_negative _ t (turn_continuous a m j) (Rnot_le_lt _ _ O2)) as [e [E G]]. exists e. split; [exact E |].
      intros s S _ [_ [Y _]]. pose proof (G s S). lra.
    + destruct (near_negative _ t (turn_continuous a i m) (Rnot_le_lt _ _ O1)) as [e [E G]]. exists e. split; [exact E |].
      intros s S _ [Y _]. pose proof (G s S). lra.
  - intros t T H. apply NNPP in H. destruct H as [O1 [O2 O3]]. pose proof (faces_left t a i j T A F) as D.
    assert (P1 : 0 < orient (x t a) (x t i) (x t m)).
    { destruct (Rle_lt_or_eq_dec _ _ O1) as [L | Z]; [exact L | exfalso]. symmetry in Z.
      apply (edge_free t a i m T Ei M Da Di). now apply on_side with (x t j). }
    assert (P3 : 0 < orient (x t i) (x t j) (x t m)).
    { destruct (Rle_lt_or_eq_dec _ _ O3) as [L | Z]; [exact L | exfalso]. symmetry in Z.
      apply (edge_free t i j m T Eij M Di Dj). apply on_side with (x t a); unfold orient in *; lra. }
    assert (P2 : 0 < orient (x t a) (x t m) (x t j)).
    { destruct (Rle_lt_or_eq_dec _ _ O2) as [L | Z]; [exact L | exfalso]. symmetry in Z.
      apply (edge_free t a j m T Ej M Da Dj). destruct (on_side (x t j) (x t a) (x t i) (x t m)) as [s [S E]];
        try (unfold orient in *; lra). exists (1 - s). split; [lra |]. rewrite E. apply mix_swap. }
    pose proof (near_positive _ t (turn_continuous a m j) P2) as Y2.
    pose proof (near_positive _ t (turn_continuous i j m) P3) as Y3.
    destruct (near_and _ _ _ (near_positive _ t (turn_continuous a i m) P1) (near_and _ _ _ Y2 Y3)) as [e [E G]].
    clear Y2 Y3.
    exists e. split; [exact E |]. intros s S _ Ne. apply Ne. destruct (G s S) as [Y1 [Y2 Y3]]. unfold in_face. lra.
Qed.

(* At the end: corners of the rim are strictly farthest in some direction. *)
Lemma at_1 k : x 1 k = q k.
Proof. apply mix_1. Qed.

Lemma rim_sure u v w : rim u v -> rim v w -> sure_hull N (fun k => at_point (q k)) v.
Proof.
  intros Ruv Rvw. destruct (rim_sites _ _ _ _ _ sk u v Ruv) as [U [V [Duv _]]].
  destruct (rim_sites _ _ _ _ _ sk v w Rvw) as [_ [W [Dvw _]]]. pose proof (rim_turns _ _ _ _ _ sk u v w Ruv Rvw) as Duw.
  set (d := (snd (q w) - snd (q u), - (fst (q w) - fst (q u)))).
  exists d. intros k y z K D Y Z.
  rewrite (proj2 (at_point_exact (q v)) y Y), (proj2 (at_point_exact (q k)) z Z).
  assert (E : dot d (q v) - dot d (q k) = orient (q u) (q v) (q k) + orient (q v) (q w) (q k))
    by (unfold d, dot, orient; simpl; ring).
  assert (St : forall a b c, rim a b -> (c < N)%nat -> c <> a -> c <> b -> 0 < orient (q a) (q b) (q c)).
  { intros a b c R C Da Db. pose proof (rim_stays a b c R C Da Db) as L. now rewrite !at_1 in L. }
  destruct (Nat.eq_dec k u) as [-> | Du].
  - pose proof (St v w u Rvw U Duv Duw) as L. assert (orient (q u) (q v) (q u) = 0) by (unfold orient; ring). lra.
  - pose proof (St u v k Ruv K Du D) as L. destruct (Nat.eq_dec k w) as [-> | Dw].
    + assert (orient (q v) (q w) (q w) = 0) by (unfold orient; ring). lra.
    + pose proof (St v w k Rvw K D Dw). lra.
Qed.

Theorem nothing_changes : (forall i j, edge i j -> strict_edge N q i j) /\
  forall a b, (a < N)%nat -> (b < N)%nat -> a <> b -> (forall i j, In (i, j) (faces a) -> b <> i /\ b <> j) ->
    ~ weak_edge N q a b.
Proof.
  assert (Eq : forall i j, edge i j -> strict_edge N q i j).
  { intros i j E. destruct (edges_stay 1 i j ltac:(lra) E) as [o [A H]]. exists o. rewrite !at_1 in A. split; [exact A |].
    intros k K Di Dj. pose proof (H k K Di Dj) as L. now rewrite !at_1 in L. }
  split; [exact Eq |]. intros a b A B D Nb Wk. set (Bq := fun k => at_point (q k)).
  apply (other_pairs_are_illegal N Bq q a b (faces a) A B D (at_points_choice N q)).
  - split; [now apply (some_face _ _ _ _ _ sk) |]. intros i j F.
    destruct (face_edges _ _ _ _ _ sk a i j A F) as [Ei [Ej Eij]].
    split; [now apply (face_sites _ _ _ _ _ sk a i j A F) |].
    split; [split; [| split]; apply strict_edge_legal; now apply Eq |].
    split; [pose proof (faces_left 1 a i j ltac:(lra) A F) as L; now rewrite !at_1 in L |].
    split; [intros m M Da Di Dj; pose proof (faces_stay_empty a i j m A F M Da Di Dj) as L; unfold in_face in L;
      now rewrite !at_1 in L |].
    assert (Side : forall u v, rim u v -> forall m, (m < N)%nat -> 0 <= orient (q u) (q v) (q m)).
    { intros u v R m M. pose proof (rim_strict_weak 1 rim_stays u v m R M) as L. now rewrite !at_1 in L. }
    split.
    + destruct (face_before _ _ _ _ _ sk a i j A F) as [X | R]; [now left | right]. split; [| now apply Side].
      destruct (rim_goes_on _ _ _ _ _ sk a i R) as [[w Rw] _]. now apply rim_sure with a w.
    + destruct (face_after _ _ _ _ _ sk a i j A F) as [X | R]; [now left | right]. split.
      * destruct (rim_goes_on _ _ _ _ _ sk j a R) as [_ [t Rt]]. now apply rim_sure with t a.
      * intros m M. rewrite <- (Rplus_0_r 0). pose proof (Side j a R m M). unfold orient in *. lra.
  - exact Nb.
  - apply possible_exact; [exact A | exact B |]. exists q. split; [apply at_points_choice | exact Wk].
Qed.
End Move.
