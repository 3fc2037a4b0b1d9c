(* SPDX-License-Identifier: LGPL-3.0-or-later *)
(* The flood finds all triangles of a Delaunay triangulation, ties allowed, whose disc or half-plane meets an open convex set,
   and which sets these are [WIT-FAT]. Flood.v walks from a triangle to the next. *)
From Coq Require Import Reals Lra Lia Psatz Classical List.
From Dyadel Require Import Plane Finite Distance Orientation Disc Path Fan TiedRim Inserted.
From Dyadel Require Import Flood.
Open Scope R_scope.

(* ---- points in general position ---- *)

Lemma small_of_near P : near 0 P -> small P.
Proof. intros [e [E H]]. exists e. split; [exact E |]. intros d D. apply H. rewrite Rminus_0_r, Rabs_pos_eq; lra. Qed.

Lemma small_positive f : continuity f -> 0 < f 0 -> small (fun e => 0 < f e).
Proof. intros C H. apply small_of_near. now apply near_positive. Qed.

Lemma small_nonzero A B C : A <> 0 \/ B <> 0 \/ C <> 0 -> small (fun e => A + e * (B + e * C) <> 0).
Proof.
  intros H.
  assert (K : forall A B C, A <> 0 -> small (fun e => A + e * (B + e * C) <> 0)).
  { clear. intros A B C D. destruct (Rtotal_order A 0) as [L | [L | L]]; [| contradiction |].
    - assert (Q : small (fun e => 0 < - (A + e * (B + e * C)))) by (apply small_positive; [reg | lra]).
      revert Q. apply small_weaken. intros e _ Q. lra.
    - assert (Q : small (fun e => 0 < A + e * (B + e * C))) by (apply small_positive; [reg | lra]).
      revert Q. apply small_weaken. intros e _ Q. lra. }
  destruct (Req_dec A 0) as [-> | DA]; [| now apply K]. destruct (Req_dec B 0) as [-> | DB].
  - exists 1. split; [lra |]. intros e E Z. destruct H as [H | [H | H]]; try (now apply H).
    apply H. assert (X : e * (e * C) = 0) by lra. apply Rmult_integral in X. destruct X as [X | X]; [lra |].
    apply Rmult_integral in X. destruct X; [lra | assumption].
  - pose proof (K B C 0 DB) as Q. revert Q. apply small_weaken. intros e E Q Z. apply Q.
    assert (X : e * (B + e * C) = 0) by lra. apply Rmult_integral in X. destruct X; lra.
Qed.

Definition bent (g : point) (e : R) : point := (fst g + e, snd g + e * e).

Lemma bent_off a b g : a <> b -> small (fun e => orient a b (bent g e) <> 0).
Proof.
  intros D. pose proof (small_nonzero (orient a b g) (- (snd b - snd a)) (fst b - fst a)) as Q.
  assert (H : orient a b g <> 0 \/ - (snd b - snd a) <> 0 \/ fst b - fst a <> 0).
  { apply NNPP. intros N. apply D. rewrite (surjective_pairing a), (surjective_pairing b).
    destruct (Req_dec (snd b - snd a) 0); [| exfalso; apply N; right; left; lra].
    destruct (Req_dec (fst b - fst a) 0); [| exfalso; apply N; right; right; lra]. f_equal; lra. }
  specialize (Q H). revert Q. apply small_weaken. intros e _ Q Z. apply Q. rewrite <- Z. unfold orient, bent. simpl.
    ring.
Qed.

Lemma small_some P : small P -> exists e, 0 < e /\ P e.
Proof. intros [e [E H]]. exists e. split; [exact E | apply H; lra]. Qed.

Section Flood.
Variables (N : nat) (p : nat -> point) (T : mesh).
Variable skeleton : delaunay N p (fun k => (k < N)%nat) T.
Variable distinct : forall v w, (v < N)%nat -> (w < N)%nat -> v <> w -> p v <> p w.
Variable S : point -> Prop.
Variable convex : forall u v s, 0 <= s <= 1 -> S u -> S v -> S (mix s u v).
Variable opened : forall u, S u -> exists e, 0 < e /\ forall v, dist u v < e -> S v.

(* A point strictly within a triangle is strictly on the inner side of all hull edges. *)
Lemma inner_point i j l o : T i j l -> (i < N)%nat -> (j < N)%nat -> (l < N)%nat -> 0 < orient (p i) (p j) o ->
  0 < orient (p j) (p l) o -> 0 < orient (p l) (p i) o -> forall a b, T a b N -> orient (p a) (p b) o < 0.
Proof.
  intros F I J L A B C a b G. destruct (reals N p T skeleton i j l F) as (_ & _ & _ & O); try lia.
  destruct (apart N p T skeleton a b N G) as (Dab & Db & Da).
  pose proof (real N p T skeleton _ _ _ G (not_eq_sym Da)) as La.
  pose proof (real N p T skeleton _ _ _ (turn N p T skeleton _ _ _ G) Db) as Lb.
  assert (H : forall z, (z < N)%nat -> orient (p a) (p b) (p z) <= 0).
  { intros z Z. pose proof (not_met_by_site N p T skeleton a b N z G Z) as Q. unfold test_at in Q.
    destruct (Nat.eqb_spec a N); [lia |]. destruct (Nat.eqb_spec b N); [lia |]. now rewrite Nat.eqb_refl in Q. }
  pose proof (H i I) as Hi. pose proof (H j J) as Hj. pose proof (H l L) as Hl.
  set (hi := orient (p a) (p b) (p i)) in *. set (hj := orient (p a) (p b) (p j)) in *.
  set (hl := orient (p a) (p b) (p l)) in *.
  assert (E : orient (p i) (p j) (p l) * orient (p a) (p b) o =
    orient (p j) (p l) o * hi + orient (p l) (p i) o * hj + orient (p i) (p j) o * hl)
    by (unfold hi, hj, hl, orient; ring).
  assert (P1 : 0 <= orient (p j) (p l) o * - hi) by (apply Rmult_le_pos; lra).
  assert (P2 : 0 <= orient (p l) (p i) o * - hj) by (apply Rmult_le_pos; lra).
  assert (P3 : 0 <= orient (p i) (p j) o * - hl) by (apply Rmult_le_pos; lra).
  apply Rnot_le_lt. intros Q. assert (0 <= orient (p i) (p j) (p l) * orient (p a) (p b) o) by (apply Rmult_le_pos;
    lra).
  assert (Zi : hi = 0) by nra. assert (Zj : hj = 0) by nra. assert (Zl : hl = 0) by nra.
  pose proof (dist_pos _ _ (distinct a b La Lb Dab)) as Dp.
  assert (Sq : 0 < dist2 (p a) (p b)) by (rewrite <- dist_sq; nra).
  set (k u := (fst u - fst (p a)) * (fst (p b) - fst (p a)) + (snd u - snd (p a)) * (snd (p b) - snd (p a))).
  assert (W : dist2 (p a) (p b) * orient (p i) (p j) (p l) =
    hi * (k (p l) - k (p j)) + hj * (k (p i) - k (p l)) + hl * (k (p j) - k (p i)))
    by (unfold hi, hj, hl, k, dist2, orient; ring).
  rewrite Zi, Zj, Zl in W. assert (0 < dist2 (p a) (p b) * orient (p i) (p j) (p l)) by (now apply
    Rmult_lt_0_compat). lra.
Qed.

Lemma test_continuous a b c g : continuity (fun e => test_at N p a b c (bent g e)).
Proof.
  unfold test_at. destruct (Nat.eqb a N); [| destruct (Nat.eqb b N); [| destruct (Nat.eqb c N)]];
    unfold incircle, dist2, orient, bent; simpl; reg.
Qed.

(* A point of S in general position, in conflict with the triangle. *)
Lemma general_point a b c k : T a b c -> (k < N)%nat -> met N p S a b c ->
  exists y, S y /\ 0 < test_at N p a b c y /\ (forall m, (m < N)%nat -> y <> p m) /\
    forall s, 0 <= s < 1 -> free N p (mix s y (p k)).
Proof.
  intros F K (y0 & S0 & M0). destruct (opened y0 S0) as [r [R0 R]].
  assert (Q : small (fun e => (S (bent y0 e) /\ 0 < test_at N p a b c (bent y0 e)) /\
    (fst y0 - fst (p k) + e * (1 + e * 0) <> 0 /\
     forall m, (m < N)%nat -> m <> k -> orient (p k) (p m) (bent y0 e) <> 0))).
  { apply small_and; apply small_and.
    - exists (Rmin 1 (r / 3)). split; [apply Rmin_pos; lra |]. intros d D. pose proof (Rmin_l 1 (r / 3)).
      pose proof (Rmin_r 1 (r / 3)). apply R. apply Rle_lt_trans with (2 * d); [| lra].
      apply le_of_squares; [lra |]. rewrite dist_sq. unfold dist2, bent. simpl. assert (d * d <= d) by nra.
      assert (0 <= d * d) by nra. nra.
    - apply small_positive; [apply test_continuous |]. unfold bent. replace (fst y0 + 0) with (fst y0) by ring.
      replace (snd y0 + 0 * 0) with (snd y0) by ring. now rewrite <- surjective_pairing.
    - apply small_nonzero. right. left. lra.
    - apply small_finite. intros m M. destruct (Nat.eq_dec m k) as [-> | D].
      + exists 1. split; [lra |]. intros; congruence.
      + pose proof (bent_off (p k) (p m) y0 (distinct k m K M (not_eq_sym D))) as Q. revert Q. apply small_weaken.
        auto. }
  apply small_some in Q. destruct Q as (e & E & (Sy & My) & Nk & Nm). exists (bent y0 e).
  assert (Fr : forall s, 0 <= s < 1 -> free N p (mix s (bent y0 e) (p k))).
  { intros s Hs m M X. destruct (Nat.eq_dec m k) as [-> | D].
    - assert (Z : (1 - s) * (fst y0 + e - fst (p k)) = 0).
      { apply (f_equal fst) in X. unfold mix, bent in X. simpl in X. lra. }
      apply Rmult_integral in Z. destruct Z; [lra | apply Nk; lra].
    - apply (Nm m M D). assert (Z : (1 - s) * orient (p k) (p m) (bent y0 e) = 0).
      { replace ((1 - s) * orient (p k) (p m) (bent y0 e)) with (orient (p k) (p m) (mix s (bent y0 e) (p k)))
          by (unfold orient, mix; simpl; ring). rewrite X. unfold orient. ring. }
      apply Rmult_integral in Z. destruct Z; [lra | assumption]. }
  split; [exact Sy |]. split; [exact My |]. split; [| exact Fr]. intros m M X. apply (Fr 0 ltac:(lra) m M). now
    rewrite mix_0.
Qed.

Lemma flood_real a b c k : T a b c -> a <> N -> b <> N -> c <> N -> (k < N)%nat -> S (p k) -> met N p S a b c ->
  exists u v, reached T (met N p S) a b c k u v.
Proof.
  intros F A B C K Sk M. destruct (general_point a b c k F K M) as (y & Sy & My & Fy & Fr).
  destruct (reals N p T skeleton a b c F A B C) as (La & Lb & Lc & O).
  set (g := (((fst (p a) + fst (p b) + fst (p c)) / 3, (snd (p a) + snd (p b) + snd (p c)) / 3) : point)).
  assert (Q : small (fun e => (0 < orient (p a) (p b) (bent g e) /\ 0 < orient (p b) (p c) (bent g e)) /\
    (0 < orient (p c) (p a) (bent g e) /\ forall m, (m < N)%nat -> orient y (p m) (bent g e) <> 0))).
  { assert (Cont : forall u v, continuity (fun e => orient u v (bent g e)))
      by (intros u v; unfold orient, bent; simpl; reg).
    apply small_and; apply small_and; try (apply small_positive; [apply Cont |]).
    - replace (orient (p a) (p b) (bent g 0)) with (orient (p a) (p b) (p c) / 3)
        by (unfold g, bent, orient; simpl; field). lra.
    - replace (orient (p b) (p c) (bent g 0)) with (orient (p a) (p b) (p c) / 3)
        by (unfold g, bent, orient; simpl; field). lra.
    - replace (orient (p c) (p a) (bent g 0)) with (orient (p a) (p b) (p c) / 3)
        by (unfold g, bent, orient; simpl; field). lra.
    - apply small_finite. intros m Hm. apply bent_off. now apply Fy. }
  apply small_some in Q. destruct Q as (e & E & (O1 & O2) & O3 & Off). set (o := bent g e) in *.
  pose proof (inner_point a b c o F La Lb Lc O1 O2 O3) as Inner.
  assert (Fo : forall s, 0 <= s <= 1 -> free N p (mix s o y)).
  { intros s Hs m Hm X. destruct (Req_dec s 1) as [-> | D]; [rewrite mix_1 in X; now apply (Fy m) |].
    apply (Off m Hm). assert (Z : (1 - s) * orient y (p m) o = 0).
    { replace ((1 - s) * orient y (p m) o) with (orient y (p m) (mix s o y)) by (unfold orient, mix; simpl; ring).
      rewrite X. unfold orient. ring. }
    apply Rmult_integral in Z. destruct Z; [lra | assumption]. }
  assert (Wo : within N p o a b c o).
  { unfold within, side. destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N); [congruence |].
    destruct (Nat.eqb_spec c N); [congruence |]. lra. }
  destruct (to_point N p T o skeleton distinct Inner a b c y F Wo My Fo) as (a' & b' & c' & R & W).
  assert (F' : T a' b' c') by apply (reached_in N p T skeleton _ a b c F a' b' c' R).
  destruct (to_site N p T o skeleton distinct Inner S convex a' b' c' y k F' K W Sy Sk Fr) as (u & v & R').
  exists u, v. apply (reached_on T _ a b c a' b' c'); [| exact R']. revert R. apply reached_more. intros x1 x2 x3 X.
    now exists y.
Qed.

Lemma flood_ghost a b k : T a b N -> (k < N)%nat -> S (p k) -> met N p S a b N ->
  exists u v, reached T (met N p S) a b N k u v.
Proof.
  intros F K Sk M. destruct (general_point a b N k F K M) as (y & Sy & My & Fy & Fr).
  destruct (apart N p T skeleton a b N F) as (Dab & Db & Da). apply not_eq_sym in Da.
  pose proof (real N p T skeleton _ _ _ F Da) as La. pose proof (turn N p T skeleton _ _ _ F) as F1.
  pose proof (real N p T skeleton _ _ _ F1 Db) as Lb. destruct (proj1 (proj2 (proj2 skeleton)) a b N F) as [d G].
  assert (Y : 0 < orient (p a) (p b) y).
  { unfold test_at in My. destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N); [congruence |].
    now rewrite Nat.eqb_refl in My. }
  assert (Ed : d <> N).
  { intros ->. destruct (proj1 (proj2 (proj2 (proj2 skeleton)))) as (i & j & l & H & I & J & L).
    set (o := (((fst (p i) + fst (p j) + fst (p l)) / 3, (snd (p i) + snd (p j) + snd (p l)) / 3) : point)).
    destruct (reals N p T skeleton i j l H) as (_ & _ & _ & O); try lia.
    assert (In3 : 0 < orient (p i) (p j) o /\ 0 < orient (p j) (p l) o /\ 0 < orient (p l) (p i) o).
    { replace (orient (p i) (p j) o) with (orient (p i) (p j) (p l) / 3) by (unfold o, orient; simpl; field).
      replace (orient (p j) (p l) o) with (orient (p i) (p j) (p l) / 3) by (unfold o, orient; simpl; field).
      replace (orient (p l) (p i) o) with (orient (p i) (p j) (p l) / 3) by (unfold o, orient; simpl; field). lra. }
    destruct In3 as (I1 & I2 & I3). pose proof (inner_point i j l o H I J L I1 I2 I3 a b F).
    pose proof (inner_point i j l o H I J L I1 I2 I3 b a G). unfold orient in *. lra. }
  destruct (reals N p T skeleton b a d G Db Da Ed) as (_ & _ & Ld & O).
  set (m := mix (1 / 2) (p a) (p b)).
  assert (Q : small (fun e => 0 < orient (mix e m (p d)) (p b) y /\ 0 < - orient (mix e m (p d)) (p a) y)).
  { apply small_and; apply small_positive; try (unfold orient, mix; simpl; reg); rewrite mix_0.
    - replace (orient m (p b) y) with (orient (p a) (p b) y / 2) by (unfold m, mix, orient; simpl; field). lra.
    - replace (orient m (p a) y) with (- (orient (p a) (p b) y / 2)) by (unfold m, mix, orient; simpl; field). lra. }
  destruct Q as (e0 & E0 & H0). set (e := Rmin e0 (1 / 2)).
  assert (E : 0 < e <= e0 /\ e <= 1 / 2) by (unfold e; pose proof (Rmin_l e0 (1 / 2)); pose proof (Rmin_r e0 (1 / 2));
    assert (0 < Rmin e0 (1 / 2)) by (apply Rmin_pos; lra); lra).
  destruct (H0 e (proj1 E)) as [C1 C2]. set (o := mix e m (p d)) in *.
  assert (O1 : 0 < orient (p b) (p a) o).
  { replace (orient (p b) (p a) o) with (e * orient (p b) (p a) (p d)) by (unfold o, m, mix, orient; simpl; field).
    nra. }
  assert (O2 : 0 < orient (p a) (p d) o).
  { replace (orient (p a) (p d) o) with ((1 - e) / 2 * orient (p b) (p a) (p d))
      by (unfold o, m, mix, orient; simpl; field). nra. }
  assert (O3 : 0 < orient (p d) (p b) o).
  { replace (orient (p d) (p b) o) with ((1 - e) / 2 * orient (p b) (p a) (p d))
      by (unfold o, m, mix, orient; simpl; field). nra. }
  pose proof (inner_point b a d o G Lb La Ld O1 O2 O3) as Inner.
  apply (to_site N p T o skeleton distinct Inner S convex a b N y k F K); auto.
  unfold within, side. rewrite Nat.eqb_refl. destruct (Nat.eqb_spec a N); [congruence |].
  destruct (Nat.eqb_spec b N); [congruence |]. lra.
Qed.

(* Every triangle that S meets is joined to one at the site, through edges between triangles that S meets. *)
Theorem flood_finds a b c k : T a b c -> (k < N)%nat -> S (p k) -> met N p S a b c ->
  exists u v, reached T (met N p S) a b c k u v.
Proof.
  intros F K Sk M. pose proof (turn N p T skeleton _ _ _ F) as F1. pose proof (turn N p T skeleton _ _ _ F1) as F2.
  assert (M1 : met N p S b c a).
  { destruct M as (y & Sy & My). exists y. split; [exact Sy |]. now rewrite <- (test_turn N p T skeleton a b c). }
  assert (M2 : met N p S c a b).
  { destruct M1 as (y & Sy & My). exists y. split; [exact Sy |]. now rewrite <- (test_turn N p T skeleton b c a). }
  destruct (Nat.eq_dec a N) as [-> | A].
  - destruct (flood_ghost b c k F1 K Sk M1) as (u & v & R). exists u, v.
    apply (reached_on T _ N b c b c N); [apply reached_turn; constructor | exact R].
  - destruct (Nat.eq_dec b N) as [-> | B].
    + destruct (flood_ghost c a k F2 K Sk M2) as (u & v & R). exists u, v.
      apply (reached_on T _ a N c c a N); [apply reached_turn, reached_turn; constructor | exact R].
    + destruct (Nat.eq_dec c N) as [-> | C]; [now apply flood_ghost | now apply flood_real].
Qed.

(* So the flood from all triangles at the site, over edges to what S meets, finds all that S meets. *)
Theorem flood_finds_all (found : mesh) k : (k < N)%nat -> S (p k) -> (forall u v, T k u v -> found k u v) ->
  (forall a b c, found a b c -> found b c a) ->
  (forall a b c d, found a b c -> T b a d -> met N p S b a d -> found b a d) ->
  forall a b c, T a b c -> met N p S a b c -> found a b c.
Proof.
  intros K Sk Start Turn Over a b c F M. destruct (flood_finds a b c k F K Sk M) as (u & v & R).
  assert (Back : forall x y z, reached T (met N p S) a b c x y z ->
    T x y z /\ met N p S x y z /\ (found x y z -> found a b c)).
  { intros x y z Q. induction Q as [| x y z Q (Fx & (w & Sw & Mw) & IH) | x y z d Q (Fx & Mx & IH) G W].
    - auto.
    - split; [now apply (turn N p T skeleton) |]. split.
      + exists w. split; [exact Sw |]. now rewrite <- (test_turn N p T skeleton x y z).
      + intros I. apply IH. now apply Turn, Turn.
    - split; [exact G |]. split; [exact W |]. intros I. apply IH. now apply (Over y x d z). }
  destruct (Back k u v R) as (G & _ & I). now apply I, Start.
Qed.
End Flood.

(* The points nearer than E to a convex set are a convex set. *)
Definition close_to (K : point -> Prop) (E : R) (y : point) : Prop := exists w, K w /\ dist y w < E.

Theorem close_convex (K : point -> Prop) E : (forall u v s, 0 <= s <= 1 -> K u -> K v -> K (mix s u v)) ->
  forall u v s, 0 <= s <= 1 -> close_to K E u -> close_to K E v -> close_to K E (mix s u v).
Proof.
  intros Cv u v s Hs (u' & Ku & Du) (v' & Kv & Dv). exists (mix s u' v'). split; [now apply Cv |].
  assert (A : dist (mix s u v) (mix s u' v) <= (1 - s) * dist u u').
  { apply le_of_squares; [apply Rmult_le_pos; [lra | apply dist_nonneg] |]. rewrite dist_sq.
    replace ((1 - s) * dist u u' * ((1 - s) * dist u u')) with ((1 - s) * (1 - s) * (dist u u' * dist u u')) by ring.
    rewrite dist_sq. right. unfold dist2, mix. simpl. ring. }
  assert (B : dist (mix s u' v) (mix s u' v') <= s * dist v v').
  { apply le_of_squares; [apply Rmult_le_pos; [lra | apply dist_nonneg] |]. rewrite dist_sq.
    replace (s * dist v v' * (s * dist v v')) with (s * s * (dist v v' * dist v v')) by ring.
    rewrite dist_sq. right. unfold dist2, mix. simpl. ring. }
  pose proof (dist_triangle (mix s u v) (mix s u' v) (mix s u' v')) as Q.
  destruct (Req_dec s 1) as [-> | D]; [lra |]. assert ((1 - s) * dist u u' < (1 - s) * E) by (apply
    Rmult_lt_compat_l; lra).
  assert (s * dist v v' <= s * E) by (apply Rmult_le_compat_l; lra). lra.
Qed.

Theorem close_open (K : point -> Prop) E u : close_to K E u -> exists e, 0 < e /\ forall v, dist u v < e -> close_to
  K E v.
Proof.
  intros (w & Kw & Dw). exists (E - dist u w). split; [lra |]. intros v V. exists w. split; [exact Kw |].
  pose proof (dist_triangle v u w). rewrite (dist_sym v u) in *. lra.
Qed.

(* Within E of the closed disc, or of the closed half-plane: met by the points nearer than a little more. *)
Theorem met_by_distance K E F o r : 0 < r -> 0 <= E < F -> (exists w, K w /\ dist o w <= r + E) ->
  exists y, close_to K F y /\ dist o y < r.
Proof.
  intros R0 EF (w & Kw & D). destruct (Rlt_dec (dist o w) r) as [L | L].
  - exists w. split; [| exact L]. exists w. split; [exact Kw |]. rewrite dist_self. lra.
  - set (d := dist o w) in *. set (t := (d - r + Rmin r ((F - E) / 2)) / d).
    assert (M : 0 < Rmin r ((F - E) / 2)) by (apply Rmin_pos; lra).
    pose proof (Rmin_l r ((F - E) / 2)). pose proof (Rmin_r r ((F - E) / 2)).
    assert (Td : t * d = d - r + Rmin r ((F - E) / 2)) by (unfold t; field; lra).
    assert (T0 : 0 <= t) by (apply (Rmult_le_reg_r d); lra).
    assert (T1 : t <= 1) by (apply (Rmult_le_reg_r d); lra).
    exists (mix t w o). split.
    + exists w. split; [exact Kw |]. rewrite dist_sym, dist_mix_left, dist_sym by exact T0. fold d. lra.
    + rewrite dist_sym, dist_mix_right, dist_sym by exact T1. fold d. lra.
Qed.

Theorem met_circle N p a b c y : a <> N -> b <> N -> c <> N -> 0 < orient (p a) (p b) (p c) ->
  (forall o r, circle o r (p a) (p b) (p c) -> dist o y < r) -> 0 < test_at N p a b c y.
Proof.
  intros A B C O H. destruct (centre_of _ _ _ O) as (w & X & Y & E). unfold test_at.
  destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N); [congruence |].
  destruct (Nat.eqb_spec c N); [congruence |]. rewrite E.
  pose proof (H _ _ (about_circle _ _ _ _ X Y)) as L. apply dist_lt in L. unfold about.
  assert (0 < orient (p a) (p b) (p c) * (dist2 w (p a) - dist2 w y)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

Theorem met_half_plane N p a b (K : point -> Prop) E F : a <> N -> b <> N -> p a <> p b -> 0 <= E < F ->
  (exists w, K w /\ - (E * dist (p a) (p b)) <= orient (p a) (p b) w) ->
  exists y, close_to K F y /\ 0 < test_at N p a b N y.
Proof.
  intros A B D EF (w & Kw & H). pose proof (dist_pos _ _ D) as L. set (d := dist (p a) (p b)) in *.
  set (k := (E + F) / 2 / d). assert (Kd : k * d = (E + F) / 2) by (unfold k; field; lra).
  assert (Sq : d * d = dist2 (p a) (p b)) by (unfold d; apply dist_sq).
  set (y := ((fst w - k * (snd (p b) - snd (p a)), snd w + k * (fst (p b) - fst (p a))) : point)).
  exists y. split.
  - exists w. split; [exact Kw |]. apply Rle_lt_trans with (k * d); [| lra].
    apply le_of_squares; [lra |]. rewrite dist_sq. replace (k * d * (k * d)) with (k * k * (d * d)) by ring.
    rewrite Sq. right. unfold y, dist2. simpl. ring.
  - unfold test_at. destruct (Nat.eqb_spec a N); [congruence |]. destruct (Nat.eqb_spec b N); [congruence |].
    rewrite Nat.eqb_refl. replace (orient (p a) (p b) y) with (orient (p a) (p b) w + k * dist2 (p a) (p b))
      by (unfold y, orient, dist2; simpl; ring).
    rewrite <- Sq. replace (k * (d * d)) with (k * d * d) by ring. rewrite Kd.
    assert (E * d < (E + F) / 2 * d) by (apply Rmult_lt_compat_r; lra). lra.
Qed.
